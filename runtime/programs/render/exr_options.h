// runtime/programs/render/exr_options.h: how EXR files are written, and what their headers say.
#pragma once

#include <string>

#include "runtime/programs/common/command_line.h"
#include "runtime/programs/render/options.h"
#include "runtime/scene/images/image_io.h"

namespace kinora {

struct Scene;

struct ExrGiven {
    std::string parts, compression;
};
void declare_exr(CLI::App& app, ExrGiven& given, RenderOptions& options);
void interpret_exr(const ExrGiven& given, RenderOptions& options);

// The format of the pictures.
ExrFormat exr_format(const RenderOptions& options);

// Who made the picture and, with --stamp, when and where.
ImageTexts stamp_texts(const RenderOptions& options);

// Whether the compression would change numbers that stand for names.
bool loses_digits(const RenderOptions& options, const Scene& scene);

}  // namespace kinora
