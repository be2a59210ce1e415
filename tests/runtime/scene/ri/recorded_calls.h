// tests/runtime/scene/ri/recorded_calls.h: a stream's calls and findings as texts that compare.
#pragma once

#include <fmt/format.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/scene/ri/bytestream/read_stream.h"
#include "runtime/scene/ri/bytestream/write_stream.h"
#include "runtime/scene/ri/calls/context.h"

namespace kinora::ri {

inline std::string text_of(const Values& values) {
    std::string text = values.is_array() ? "[" : "";
    auto add = [&](const std::string& word) {
        text += (text.empty() || text == "[" ? "" : " ") + word;
    };
    for (int value : values.integers()) add(fmt::format("{}", value));
    for (float value : values.floats()) add(fmt::format("{}", value));
    for (const char* value : values.strings()) add(fmt::format("\"{}\"", value));
    if (values.function()) add("function");
    // Integers and floats look alike.
    constexpr std::string_view kKinds[] = {"i", "", "", ""};
    return text + (values.is_array() ? "]" : "") + std::string(kKinds[size_t(values.kind())]);
}

inline std::string text_of(const Call& call) {
    std::string text(row(call.request).name);
    for (const Values& values : call.arguments) text += ' ' + text_of(values);
    for (const Parameter& parameter : call.parameters)
        text += fmt::format(" \"{} {}\" {}", declaration_text(parameter.declaration),
                            parameter.name, text_of(parameter.values));
    return text;
}

// Keeps each call as a text, and may do something more with it.
class RecordingSink : public CallSink {
  public:
    explicit RecordingSink(std::vector<std::string>& calls) : calls_(calls) {}
    void call(const Call& call) override {
        calls_.push_back(text_of(call));
        if (then) then(call);
    }
    const Declaration* declared_by_shader(Request, std::string_view shader,
                                          std::string_view token) override {
        static const Declaration kColor{StorageClass::Uniform, Type::Color, 0};
        return shader == "wood" && token == "grain" ? &kColor : nullptr;
    }

    std::function<void(const Call& call)> then;

  private:
    std::vector<std::string>& calls_;
};

struct ReadCalls {
    std::vector<std::string> calls;
    std::vector<std::string> findings;  // "CODE 1:2"
    std::vector<std::string> messages;
    bool is_rib = false;
};

inline void note_findings(const Diagnostics& diagnostics, ReadCalls& read) {
    for (const Finding& finding : diagnostics.findings()) {
        std::string place = "-";
        if (finding.where.file != kNoFile) {
            LineColumn at = diagnostics.files.line_column(finding.where.file, finding.where.begin);
            place = fmt::format("{}:{}", at.line, at.column);
        }
        read.findings.push_back(fmt::format("{} {}", finding.info->code, place));
        read.messages.push_back(finding.message);
    }
}

inline ReadCalls read_calls(std::string bytes, CallSink* other = nullptr) {
    ReadCalls read;
    Diagnostics diagnostics;
    auto sink = std::make_unique<RecordingSink>(read.calls);
    if (other) sink->then = [other](const Call& call) { other->call(call); };
    Context context(std::move(sink), diagnostics);
    read.is_rib = BytestreamReader(context).read("test.rib", std::move(bytes));
    note_findings(diagnostics, read);
    return read;
}

// The calls of a stream, written in this form.
inline std::string rewritten(std::string bytes, StreamForm form) {
    std::string written;
    StreamWriter writer(form, [&](std::string_view piece) { written += piece; });
    read_calls(std::move(bytes), &writer);
    return written;
}

using Texts = std::vector<std::string>;

}  // namespace kinora::ri
