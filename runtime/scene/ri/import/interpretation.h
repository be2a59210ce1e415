// runtime/scene/ri/import/interpretation.h: a context whose calls become scenes, and the files that
// are read for it.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "runtime/base/diagnostic.h"
#include "runtime/scene/description/import_options.h"
#include "runtime/scene/description/scene_description.h"
#include "runtime/scene/ri/bytestream/read_stream.h"
#include "runtime/scene/ri/calls/context.h"
#include "runtime/scene/ri/state/interpreter.h"

namespace kinora::ri {

class Interpretation {
  public:
    // Gets each world block, in order. False from it ends the reading of files.
    using Take = std::function<bool(SceneDescription&& world)>;

    // `path` as Interpreter has it.
    Interpretation(const std::string& path, const ImportOptions& options, WorldChoice drawn,
                   Diagnostics& diagnostics, Take take);
    Interpretation(const Interpretation&) = delete;

    Context& context() { return *context_; }
    // As BytestreamReader::read.
    bool read(const std::string& name, std::string bytes);
    // Closes what is open, with a finding; after the reading was ended nothing is done.
    void finish();

  private:
    InterpreterHost host();
    void take_world(SceneDescription&& world);

    Take take_;
    bool stopped_ = false;
    Interpreter* interpreter_;  // the context's
    std::optional<Context> context_;
    std::optional<BytestreamReader> reader_;
};

}  // namespace kinora::ri
