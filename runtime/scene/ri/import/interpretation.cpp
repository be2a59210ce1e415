// runtime/scene/ri/import/interpretation.cpp: a context with an interpreter and a reader of files.
#include "runtime/scene/ri/import/interpretation.h"

#include <utility>

#include "runtime/base/regular_file.h"

namespace kinora::ri {

Interpretation::Interpretation(const std::string& path, const ImportOptions& options,
                               WorldChoice drawn, Diagnostics& diagnostics, Take take)
    : take_(std::move(take)) {
    auto sink = std::make_unique<Interpreter>(path, options, std::move(drawn), host(), diagnostics);
    interpreter_ = sink.get();
    context_.emplace(std::move(sink), diagnostics);
    reader_.emplace(*context_);
}

InterpreterHost Interpretation::host() {
    InterpreterHost host;
    host.take_world = [this](SceneDescription&& world) { take_world(std::move(world)); };
    host.read_archive = [this](const std::string& path) {
        std::optional<std::string> archive = read_regular_file(path);
        if (archive) read(path, std::move(*archive));
        return archive.has_value();
    };
    return host;
}

void Interpretation::take_world(SceneDescription&& world) {
    stopped_ = stopped_ || !take_(std::move(world));
    if (stopped_) reader_->stop();
}

bool Interpretation::read(const std::string& name, std::string bytes) {
    return reader_->read(name, std::move(bytes));
}

void Interpretation::finish() {
    if (!stopped_) interpreter_->finish();
}

}  // namespace kinora::ri
