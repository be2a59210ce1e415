// runtime/programs/render/film.cpp: pictures of one file, which is read once.
#include "runtime/programs/render/film.h"

#include <optional>
#include <utility>

#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/common/finding_printer.h"
#include "runtime/programs/render/frame_codes.h"
#include "runtime/programs/render/run.h"
#include "runtime/programs/render/worlds.h"

namespace kinora {

int render_worlds(const RenderOptions& options) {
    const std::optional<ChosenWorlds> worlds = worlds_to_render(options);
    if (!worlds) return kExitUsage;
    if (worlds->wanted.empty()) return Render(options).run();  // which says why
    FrameCodes codes(options.keep_going);
    FindingPrinter::Told told;
    Diagnostics found;
    const bool read = read_worlds(options, *worlds, found, [&](ReadWorld world) {
        return codes.go_on_after(Render(world.options, &world, &told).run());
    });
    if (read) return codes.code();
    FindingPrinter(options.findings, options.scene).print(found);
    return kExitUnreadable;
}

}  // namespace kinora
