// runtime/ri/rib_session.cpp: calls to a RIB file.
#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <utility>

#include "runtime/base/regular_file.h"
#include "runtime/ri/seen_spaces.h"
#include "runtime/ri/session.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/ri/bytestream/write_stream.h"
#include "runtime/scene/ri/bytestream/zip.h"
#include "runtime/scene/ri/calls/call_list.h"

namespace kinora::ri {
namespace {

// A file that is written as it comes, in blocks.
class RibFile {
  public:
    RibFile(const std::string& name, Diagnostics& diagnostics)
        : name_(name), diagnostics_(diagnostics), file_(std::fopen(name.c_str(), "wb")) {
        if (!file_) fail(std::strerror(errno));
    }
    bool zipped() const { return zipped_; }
    void set_zipped(bool zipped) { zipped_ = zipped; }
    const std::string& name() const { return name_; }

    void write(std::string_view bytes) {
        if (!file_) return;
        block_ += bytes;
        if (block_.size() >= kBlock) flush();
    }
    void close() {
        flush();
        if (file_ && std::fclose(file_.release()) != 0) fail(std::strerror(errno));
    }

  private:
    static constexpr size_t kBlock = 1 << 20;

    void flush() {
        std::string error, packed;
        if (zipped_ && !block_.empty()) packed = zip(block_, error);
        const std::string& bytes = zipped_ ? packed : block_;
        if (error.empty() && file_ &&
            std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size())
            error = std::strerror(errno);
        block_.clear();
        if (!error.empty()) fail(error);
    }
    // Once: what follows is dropped.
    void fail(const std::string& why) {
        diagnostics_.report(Code::RI_NOT_WRITTEN, Location{}, name_, why);
        file_.reset();
    }

    std::string name_;
    Diagnostics& diagnostics_;
    OpenFile file_;
    std::string block_;
    bool zipped_ = false;
};

// Whether the form of the file may still be chosen after it.
bool is_heading(const Call& call) {
    switch (call.request) {
        case Request::Option:
        case Request::Declare:
        case Request::ErrorHandler:
        case Request::ArchiveRecord:
            return true;
        default:
            return false;
    }
}

class RibSink : public CallSink {
  public:
    RibSink(RibFile& file, Diagnostics& diagnostics) : file_(file), diagnostics_(diagnostics) {
        file_.set_zipped(file.name().ends_with(".gz"));
    }

    void call(const Call& call) override {
        spaces_.see(call);
        if (call.request == Request::Option && call.arguments[0].string() == "rib")
            return choose(call);
        if (!writer_ && is_heading(call)) return heading_.add(call);
        start();
        writer_->call(call);
    }
    bool transform_points(std::string_view from, std::string_view to,
                          std::span<float> points) override {
        return spaces_.transform_points(from, to, points);
    }
    void start() {
        if (writer_) return;
        writer_.emplace(form_, [this](std::string_view bytes) { file_.write(bytes); });
        for (const Call& call : heading_.calls()) writer_->call(call);
    }

  private:
    void choose(const Call& option) {
        if (writer_) return refuse("the form of RIB is chosen before the first block or attribute");
        for (const Parameter& parameter : option.parameters) {
            const std::string_view value = parameter.values.string();
            if (parameter.name == "format" && (value == "ascii" || value == "binary"))
                form_ = value == "ascii" ? StreamForm::Ascii : StreamForm::Binary;
            else if (parameter.name == "compression" && (value == "none" || value == "gzip"))
                file_.set_zipped(value == "gzip");
            else
                refuse(fmt::format("\"rib\" \"{}\" is not '{}'", parameter.name, value));
        }
    }
    void refuse(const std::string& why) {
        diagnostics_.report(Code::RI_RANGE, Location{}, "Option", why);
    }

    RibFile& file_;
    Diagnostics& diagnostics_;
    StreamForm form_ = StreamForm::Ascii;
    CallList heading_;
    SeenSpaces spaces_;
    std::optional<StreamWriter> writer_;
};

class RibSession : public Session {
  public:
    explicit RibSession(const std::string& name)
        : file_(name, diagnostics_), context_(make_sink(), diagnostics_) {}

    Context& context() override { return context_; }
    void finish() override {
        sink_->start();
        file_.close();
    }

  private:
    std::unique_ptr<RibSink> make_sink() {
        auto sink = std::make_unique<RibSink>(file_, diagnostics_);
        sink_ = sink.get();
        return sink;
    }

    Diagnostics diagnostics_;
    RibFile file_;
    RibSink* sink_;  // the context's
    Context context_;
};

}  // namespace

std::unique_ptr<Session> rib_session(const std::string& file) {
    return std::make_unique<RibSession>(file);
}

}  // namespace kinora::ri
