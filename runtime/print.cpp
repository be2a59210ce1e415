// runtime/print.cpp: printf of shaders: formatted at once, shown in picture order after the frame.
#include "runtime/print.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <tuple>

#include "rsl/renderer_services.h"
#include "runtime/shading_p.h"

namespace kinora {

std::string print_text(const jit::ServiceCall& call, int lane) {
    const std::string& format = rsl::interned(jit::bits_of(call.args[lane]));
    int next = 1;
    auto value = [&] {
        return next <= 16 ? call.args[size_t(next++ * jit::kMaxLanes + lane)] : 0.0f;
    };
    auto several = [&](int count) {
        std::string text;
        for (int k = 0; k < count; ++k) text += fmt::format("{}{}", k ? " " : "", value());
        return text;
    };
    std::string text;
    for (size_t i = 0; i < format.size(); ++i) {
        if (format[i] != '%' || i + 1 == format.size()) {
            text += format[i];
            continue;
        }
        switch (format[++i]) {
            case 'f':
                text += several(1);
                break;
            case 'd':
                text += fmt::format("{}", int64_t(value()));
                break;
            case 'c':
            case 'p':
            case 'v':
            case 'n':
                text += several(3);
                break;
            case 'm':
                text += several(16);
                break;
            case 's':
                text += rsl::interned(jit::bits_of(value()));
                break;
            default:
                text += format[i];
                break;  // %% and whatever is unknown
        }
    }
    return text;
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
