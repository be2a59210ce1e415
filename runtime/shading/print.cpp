// runtime/shading/print.cpp: printf of shaders.
#include "runtime/shading/print.h"

#include <algorithm>
#include <cstdio>
#include <tuple>

#include "rsl/model/renderer_services.h"
#include "rsl/model/string_functions.h"

namespace kinora {

std::string print_text(const jit::ServiceCall& call, int lane) {
    float values[rsl::kMostFormatValues];
    for (int k = 0; k < rsl::kMostFormatValues; ++k)
        values[k] = call.args[(1 + k) * jit::kMaxLanes + lane];
    return rsl::format_text(rsl::interned(jit::bits_of(call.args[lane])), values);
}

void Prints::begin_frame(size_t threads) {
    prints_.resize(std::max(prints_.size(), threads));
}

void Prints::add(const Grid& grid, const jit::ServiceCall& call) {
    std::vector<Print>& prints = prints_[grid.memory.number];
    for (int lane = 0; lane < call.lanes; ++lane) {
        if (!(call.mask >> lane & 1)) continue;
        uint32_t hit = grid.points[size_t(call.first + lane)];
        prints.push_back({grid.hits.pixel_y[hit], grid.hits.pixel_x[hit], grid.hits.sample[hit],
                          uint32_t(prints.size()), print_text(call, lane)});
    }
}

void Prints::drop() {
    for (auto& prints : prints_) prints.clear();
}

void Prints::flush() {
    std::vector<Print> all;
    for (auto& prints : prints_) {
        std::move(prints.begin(), prints.end(), std::back_inserter(all));
        prints.clear();
    }
    std::sort(all.begin(), all.end(), [](const Print& a, const Print& b) {
        return std::tie(a.pixel_y, a.pixel_x, a.sample, a.order) <
               std::tie(b.pixel_y, b.pixel_x, b.sample, b.order);
    });
    for (const Print& print : all) std::fputs(print.text.c_str(), stdout);
}

}  // namespace kinora
