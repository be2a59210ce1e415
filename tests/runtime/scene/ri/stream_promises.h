// tests/runtime/scene/ri/stream_promises.h: what holds for any bytes that are read as RIB.
#pragma once

#include <string>

#include "tests/runtime/scene/ri/recorded_calls.h"

namespace kinora::ri {

// "": all holds. Each call has as many arguments and values as it should, all of which can be read;
// findings lie in the stream; what is written of it is read without a finding, as the same calls.
inline std::string broken_promise(const std::string& bytes) {
    std::string broken, written[2];
    Texts calls, findings;
    Diagnostics diagnostics;
    StreamWriter ascii(StreamForm::Ascii, [&](std::string_view piece) { written[0] += piece; });
    StreamWriter binary(StreamForm::Binary, [&](std::string_view piece) { written[1] += piece; });
    auto sink = std::make_unique<RecordingSink>(calls);
    RecordingSink* recording = sink.get();
    Context context(std::move(sink), diagnostics);
    recording->then = [&](const Call& call) {
        for (const Parameter& parameter : call.parameters) {
            size_t count =
                size_t(call.counts.of(parameter.declaration.storage)) *
                parameter.declaration.elements() *
                components(parameter.declaration.type, context.count_state().color_samples);
            if (parameter.values.size() != count)
                broken = "as many values as wanted: " + calls.back();
        }
        ascii.call(call);
        binary.call(call);
    };
    BytestreamReader(context).read("fuzz.rib", bytes);
    for (const Finding& finding : diagnostics.findings())
        if (finding.where.file != kNoFile &&
            finding.where.end > diagnostics.files.text(finding.where.file).size())
            broken = "findings lie in the file: " + finding.message;
    for (const std::string& text : written) {
        if (calls.empty() || !broken.empty()) break;
        ReadCalls again = read_calls(text);
        for (size_t i = 0; i < calls.size(); ++i)
            if (i >= again.calls.size() || again.calls[i] != calls[i])
                return "calls that are written are read: " + calls[i];
        if (again.calls.size() != calls.size()) return "no more calls are read than were written";
    }
    return broken;
}

}  // namespace kinora::ri
