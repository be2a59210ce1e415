// runtime/picture/shading/print.cpp: printf of shaders at the points of pictures.
#include "runtime/picture/shading/print.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <string_view>
#include <tuple>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/shaders/printed_lines.h"

namespace kinora {

bool Prints::Print::operator<(const Print& o) const {
    return std::tie(pixel_y, pixel_x, sample, order) <
           std::tie(o.pixel_y, o.pixel_x, o.sample, o.order);
}

void Prints::begin_frame(size_t threads) {
    threads_.resize(std::max(threads_.size(), threads));
}

// Which lines are the first of the picture is known at its end, so each thread keeps its own first:
// what goes here could not come back.
void Prints::trim(OfLook& of) {
    std::sort(of.prints.begin(), of.prints.end());
    size_t kept = 0, bytes = 0;
    while (kept < of.prints.size() && kept < kMostPrints &&
           bytes + of.prints[kept].text.size() <= kMostPrintBytes)
        bytes += of.prints[kept++].text.size();
    if (kept < of.prints.size()) {
        const Print& lost = of.prints[kept];
        of.end = {lost.pixel_y, lost.pixel_x, lost.sample};
    }
    of.prints.erase(of.prints.begin() + std::ptrdiff_t(kept), of.prints.end());
    of.bytes = bytes;
}

void Prints::add(const Grid& grid, const jit::ServiceCall& call) {
    OfThread& own = threads_[grid.memory.number];
    uint32_t look = grid.look->index;
    if (own.looks.size() <= look) own.looks.resize(look + 1);
    OfLook& of = own.looks[look];
    for (int lane = 0; lane < call.lanes; ++lane) {
        if (!(call.mask >> lane & 1)) continue;
        ++of.asked;
        uint32_t hit = grid.points[size_t(call.first + lane)];
        uint32_t y = grid.hits.pixel_y[hit], x = grid.hits.pixel_x[hit];
        uint32_t sample = grid.hits.sample[hit];
        if (std::tie(y, x, sample) > of.end) continue;
        of.prints.push_back({y, x, sample, own.calls++, look, print_text(call, lane)});
        of.bytes += of.prints.back().text.size();
        if (of.prints.size() >= 2 * kMostPrints || of.bytes >= 2 * kMostPrintBytes) trim(of);
    }
}

void Prints::drop() {
    for (OfThread& thread : threads_) thread = {};
}

void Prints::flush(const SceneShaders& scene, const PrintTo& show, Diagnostics& diagnostics) {
    std::map<std::string_view, OfLook> shaders;  // one may be that of many looks
    for (OfThread& thread : threads_) {
        for (size_t look = 0; look < thread.looks.size(); ++look) {
            OfLook& of = thread.looks[look];
            if (of.asked == 0) continue;
            OfLook& sum = shaders[scene.shader_instances[look]->shader().name];
            std::move(of.prints.begin(), of.prints.end(), std::back_inserter(sum.prints));
            sum.asked += of.asked;
            of = {};
        }
        thread.calls = 0;
    }
    std::vector<Print> all;
    for (auto& [name, sum] : shaders) {
        trim(sum);
        if (sum.asked > sum.prints.size())
            diagnostics.report(Code::PRINT_LIMIT, Location{}, name, sum.asked, sum.prints.size());
        std::move(sum.prints.begin(), sum.prints.end(), std::back_inserter(all));
    }
    std::sort(all.begin(), all.end());
    for (const Print& print : all)
        if (show) show(print.text);
}

}  // namespace kinora
