// runtime/scene/ri/bytestream/write_stream.cpp: calls to RIB.
#include "runtime/scene/ri/bytestream/write_stream.h"

#include <algorithm>

#include "runtime/scene/ri/bytestream/basis_names_p.h"
#include "runtime/scene/ri/bytestream/stream_words_p.h"

namespace kinora::ri {
namespace {

constexpr std::string_view kHeading = "##RenderMan RIB-Structure 1.1\nversion 3.03\n";

bool opens(Request request) {
    return row(request).name.ends_with("Begin");
}
bool closes(Request request) {
    return row(request).name.ends_with("End");
}
// Behind an inline declaration a blank would end the name, or be left out, and a bracket be part of
// the type.
bool fits_inline(std::string_view name) {
    constexpr std::string_view kBlanks = " \t\n\v\f\r";
    auto blank = [&](char c) { return kBlanks.find(c) != kBlanks.npos; };
    return !name.empty() && !blank(name.front()) && !blank(name.back()) && name[0] != '[' &&
           name.find(' ') == name.npos;
}
// Between the parts of a condition.
bool parts(Request request) {
    return request == Request::Else || request == Request::ElseIf;
}

// What stands between brackets, or alone.
void add_values(StreamWords& words, const Values& values) {
    switch (values.kind()) {
        case Values::Kind::Integers:
            words.add_array(values.integers());
            break;
        case Values::Kind::Floats:
            words.add(values.floats());
            break;
        case Values::Kind::Strings: {
            std::vector<std::string_view> strings;
            for (const char* text : values.strings()) strings.push_back(text ? text : "");
            words.add_array(std::span<const std::string_view>(strings));
            break;
        }
        case Values::Kind::Function:
            break;
    }
}

// Comments, structure hints, and lines that are as they should be written.
std::string record(std::string_view type, std::string_view text) {
    std::string mark = type == "verbatim" ? "" : type == "structure" ? "##" : "#";
    std::string written = mark;
    for (char c : text) {
        written += c;
        if (c == '\n') written += mark;
    }
    return written + '\n';
}

}  // namespace

StreamWriter::StreamWriter(StreamForm form, Write write)
    : words_(form == StreamForm::Ascii ? ascii_words() : binary_words()), write_(std::move(write)) {
    words_->text = kHeading;
}

StreamWriter::~StreamWriter() = default;

// "Surface:wood:grain" is "grain" of one shader.
void StreamWriter::note_declaration(const Call& call) {
    std::string_view name = call.arguments[0].string();
    if (auto declaration = parse_declaration(call.arguments[1].string()))
        declared_.declare(name, *declaration);
    size_t colon = name.rfind(':');
    if (colon != name.npos) scoped_.emplace(name.substr(colon + 1));
}

std::string StreamWriter::token(const Parameter& parameter) const {
    const Declaration* known = declared_.find(parameter.name);
    if (!known) known = Declarations::standard().find(parameter.name);
    bool same = known && *known == parameter.declaration && !scoped_.contains(parameter.name);
    if (same || !fits_inline(parameter.name)) return std::string(parameter.name);
    return declaration_text(parameter.declaration) + ' ' + std::string(parameter.name);
}

void StreamWriter::add_argument(char letter, const Values& values) {
    StreamWords& words = *words_;
    if (letter == 'x') {
        std::string_view name = basis_name(values.floats());
        return name.empty() ? words.add(values.floats()) : words.add(name);
    }
    if (values.is_array()) return add_values(words, values);
    switch (values.kind()) {
        case Values::Kind::Integers:
            return words.add(values.integer());
        case Values::Kind::Floats:
            return words.add(values.real());
        case Values::Kind::Strings:
            return words.add(values.string());
        // A program's own filter, which RIB has no name for.
        case Values::Kind::Function:
            return words.add(std::string_view("gaussian"));
    }
}

void StreamWriter::add_arguments(const Call& call) {
    std::string_view letters = row(call.request).arguments;
    size_t optional = std::min(letters.find('?'), letters.size()), at = 0;
    auto empty = [](const Values& values) { return values.size() == 0; };
    bool short_form = optional < call.arguments.size() &&
                      std::ranges::all_of(call.arguments.subspan(optional), empty);
    for (char letter : letters) {
        if (letter == '?' && short_form) break;
        if (letter == '?') continue;
        if (letter == '*' || at == call.arguments.size()) break;
        add_argument(letter, call.arguments[at++]);
    }
}

void StreamWriter::call(const Call& call) {
    StreamWords& words = *words_;
    if (call.request == Request::ArchiveRecord) {
        words.text += record(call.arguments[0].string(), call.arguments[1].string());
    } else {
        if (closes(call.request) || parts(call.request)) depth_ = std::max(depth_ - 1, 0);
        words.begin_request(call.request, depth_);
        add_arguments(call);
        for (const Parameter& parameter : call.parameters) {
            words.add_token(token(parameter));
            add_values(words, parameter.values);
        }
        words.end_request();
        if (opens(call.request) || parts(call.request)) ++depth_;
    }
    if (call.request == Request::Declare) note_declaration(call);
    write_(words.text);
    words.text.clear();
}

}  // namespace kinora::ri
