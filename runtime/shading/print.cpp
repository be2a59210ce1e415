// runtime/shading/print.cpp: printf of shaders: formatted at once, shown in picture order after the
// frame.
#include "runtime/shading/print.h"

#include <algorithm>
#include <cstdio>
#include <tuple>

#include "rsl/model/renderer_services.h"
#include "rsl/model/string_functions.h"
#include "runtime/shading/shading_p.h"

namespace kinora {

std::string print_text(const jit::ServiceCall& call, int lane) {
    float values[rsl::kMostFormatValues];
    for (int k = 0; k < rsl::kMostFormatValues; ++k)
        values[k] = call.args[(1 + k) * jit::kMaxLanes + lane];
    return rsl::format_text(rsl::interned(jit::bits_of(call.args[lane])), values);
}

void Shading::print(const Grid& grid, const jit::ServiceCall& call) {
    Thread& own = thread(grid.thread);
    for (int lane = 0; lane < call.lanes; ++lane) {
        if (!(call.mask >> lane & 1)) continue;
        uint32_t hit = grid.points[size_t(call.first + lane)];
        own.prints.push_back({grid.hits.pixel_y[hit], grid.hits.pixel_x[hit], grid.hits.sample[hit],
                              uint32_t(own.prints.size()), print_text(call, lane)});
    }
}

void Shading::flush_prints() {
    std::vector<Thread::Print> all;
    for (auto& thread : threads_) {
        std::move(thread->prints.begin(), thread->prints.end(), std::back_inserter(all));
        thread->prints.clear();
    }
    std::sort(all.begin(), all.end(), [](const Thread::Print& a, const Thread::Print& b) {
        return std::tie(a.pixel_y, a.pixel_x, a.sample, a.order) <
               std::tie(b.pixel_y, b.pixel_x, b.sample, b.order);
    });
    for (const Thread::Print& print : all) std::fputs(print.text.c_str(), stdout);
}

}  // namespace kinora
