// runtime/programs/render/worlds.cpp: --frames and frame tokens for files with several pictures.
#include "runtime/programs/render/worlds.h"

#include <algorithm>
#include <cstdio>

#include "runtime/kinora/frame_list.h"
#include "runtime/scene/ri/import/import.h"

namespace kinora {

std::vector<RenderOptions> runs_of_worlds(const RenderOptions& options) {
    std::vector<int> numbers = worlds_of(options.scene);
    const bool all = !options.output.empty() && OutputName(options.output).has_token();
    std::vector<RenderOptions> runs;
    for (size_t w = 0; w < numbers.size(); ++w) {
        bool last = w + 1 == numbers.size();
        bool wanted =
            options.frames ? std::ranges::count(*options.frames, numbers[w]) > 0 : all || last;
        if (!wanted) continue;
        runs.push_back(options);
        runs.back().world = int(w);
        runs.back().frames = {{int64_t(numbers[w])}};
    }
    if (runs.empty() && numbers.empty()) runs.push_back(options);  // its import reports why
    if (runs.empty())
        std::fprintf(stderr,
                     "kinora-render: error: '%s' has %zu pictures, none of them of --frames\n",
                     options.scene.c_str(), numbers.size());
    return runs;
}

}  // namespace kinora
