// runtime/programs/render/kinora_render.cpp: a scene to a sequence of pictures.
#include <algorithm>
#include <filesystem>
#include <optional>
#include <thread>

#include "raytrace/ray_tracer.h"
#include "runtime/base/memory/heap.h"
#include "runtime/programs/common/run_program.h"
#include "runtime/programs/common/standard_streams.h"
#include "runtime/programs/render/film.h"
#include "runtime/programs/render/options.h"
#include "runtime/programs/render/run.h"
#include "runtime/scene/ri/import/import.h"

namespace kinora {

namespace {

// Of a word of the command line.
bool names_file(const char* word) {
    std::error_code code;
    return std::filesystem::is_regular_file(word, code);
}

}  // namespace

}  // namespace kinora

int main(int argc, char** argv) {
    kinora::ready_standard_streams();
    kinora::ready_heap(kinora::kHeapOfStart);
    return kinora::run_program("kinora-render", [&]() -> int {
        // Where a file is named a scene will be traced: not for --version.
        std::jthread opening;
        if (std::any_of(argv + std::min(argc, 1), argv + argc, kinora::names_file))
            opening = kinora::raytrace::open_ray_tracer_early();
        kinora::RenderOptions options;
        if (std::optional<int> code = kinora::parse_render_options(argc, argv, options))
            return *code;
        if (!kinora::is_rib(options.scene)) return kinora::Render(options).run();
        return kinora::render_worlds(options);
    });
}
