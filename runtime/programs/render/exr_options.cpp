// runtime/programs/render/exr_options.cpp: parts, compressions, owners and stamps.
#include "runtime/programs/render/exr_options.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "runtime/scene/scene.h"

namespace kinora {

namespace {

std::string names_of_compressions() {
    std::vector<std::string> names;
    for (const ExrCompression& row : exr_compressions())
        names.push_back(fmt::format("{}{}", row.name, row.most_level > 0 ? "[:LEVEL]" : ""));
    return fmt::format("{}", fmt::join(names, ", "));
}

std::string host_name() {
    char name[256] = "";
    return gethostname(name, sizeof name - 1) == 0 ? name : "";
}

}  // namespace

void declare_exr(CLI::App& app, ExrGiven& given, RenderOptions& o) {
    app.add_option("--parts", given.parts,
                   "one part of an EXR for all channels, or many: one for each AOV (one)")
        ->check(one_of({"one", "many"}));
    app.add_option("--compression", given.compression,
                   fmt::format("of an EXR: {} (zip)", names_of_compressions()));
    app.add_option("--owner", o.owner, "TEXT: owner in the header of pictures");
    app.add_flag("--stamp,!--reproducible", o.stamp,
                 "time and machine in the header, so that bytes differ from run to run; "
                 "--reproducible leaves them out (the default)");
}

void interpret_exr(const ExrGiven& given, RenderOptions& o) {
    o.exr.parts = given.parts == "many";
    if (!given.compression.empty() && !parse_compression(given.compression, o.exr))
        throw CLI::ValidationError("--compression",
                                   fmt::format("takes {}; levels of zip and zips are 0 to 9, those "
                                               "of dwaa and dwab 0 or more: not '{}'",
                                               names_of_compressions(), given.compression));
}

ExrFormat exr_format(const RenderOptions& options) {
    ExrFormat format = options.exr;
    format.depth = options.quality.depth;
    return format;
}

ImageTexts stamp_texts(const RenderOptions& options) {
    ImageTexts texts;
    if (!options.owner.empty()) texts.emplace_back("owner", options.owner);
    if (!options.stamp) return texts;
    const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    texts.emplace_back("capDate", fmt::format("{:%Y:%m:%d %H:%M:%S}", fmt::gmtime(now)));
    texts.emplace_back("kinora/host", host_name());
    return texts;
}

bool loses_digits(const RenderOptions& options, const Scene& scene) {
    const bool lossy = options.exr.lossy() && !options.exr.parts;
    return lossy && std::ranges::any_of(scene.outputs, [](const OutputPlane& plane) {
               return plane.in_file && plane.exact;
           });
}

}  // namespace kinora
