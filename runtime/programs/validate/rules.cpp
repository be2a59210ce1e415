// runtime/programs/validate/rules.cpp: the rows of all findings.def files as one list.
#include "runtime/programs/validate/rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "collada/document/findings.h"
#include "jit/ir/findings.h"
#include "rsl/text/findings.h"
#include "runtime/programs/validate/escaped_text.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/profile_rsl/findings.h"

namespace kinora {

namespace {

using Rows = std::vector<const FindingInfo*>;

// By code; of several rows with one code the first one given stays.
void order(Rows& rows) {
    auto code = [](const FindingInfo* row) { return std::string_view(row->code); };
    std::stable_sort(rows.begin(), rows.end(), [&](auto* a, auto* b) { return code(a) < code(b); });
    rows.erase(
        std::unique(rows.begin(), rows.end(), [&](auto* a, auto* b) { return code(a) == code(b); }),
        rows.end());
}

Rows make_rules() {
    Rows rows;
    for (auto row = collada::all_findings(); *row; ++row) rows.push_back(*row);
    for (const FindingInfo* row : rsl::finding_rows()) rows.push_back(row);
    for (const FindingInfo* row : {
#define FINDING(code, ...) &Code::code,
#include "runtime/programs/validate/findings.def"
#include "runtime/scene/profile_rsl/findings.def"
#undef FINDING
         })
        rows.push_back(row);
    order(rows);
    return rows;
}

Rows make_others() {
    Rows rows = {
#define FINDING(code, ...) &Code::code,
#include "runtime/scene/description/findings.def"
#undef FINDING
#define FINDING(code, ...) &jit::Code::code,
#include "jit/ir/findings.def"
#undef FINDING
    };
    order(rows);
    return rows;
}

const FindingInfo* find(const Rows& rows, std::string_view code) {
    auto at = std::lower_bound(rows.begin(), rows.end(), code,
                               [](auto* row, std::string_view c) { return row->code < c; });
    return at != rows.end() && (*at)->code == code ? *at : nullptr;
}

}  // namespace

const std::vector<const FindingInfo*>& validate_rules() {
    static const Rows kRules = make_rules();
    return kRules;
}

const FindingInfo* find_rule(std::string_view code) {
    static const Rows kOthers = make_others();
    const FindingInfo* own = find(validate_rules(), code);
    return own ? own : find(kOthers, code);
}

std::optional<size_t> rule_index(const FindingInfo& info) {
    const Rows& rows = validate_rules();
    auto at = std::lower_bound(rows.begin(), rows.end(), std::string_view(info.code),
                               [](auto* row, std::string_view c) { return row->code < c; });
    if (at == rows.end() || std::string_view((*at)->code) != info.code) return std::nullopt;
    return size_t(at - rows.begin());
}

std::optional<Severity> parse_severity(std::string_view name) {
    for (int s = 0; s <= int(Severity::Error); ++s)
        if (name == severity_name(Severity(s))) return Severity(s);
    return std::nullopt;
}

// The text with "…" for its values; where it is nothing else, what the explanation says first.
std::string rule_text(const FindingInfo& info) {
    std::string text;
    bool says_something = false;
    for (const char* c = info.text; *c; ++c) {
        if (*c == '{' && c[1] != '{') {
            while (*c && *c != '}') ++c;
            text += "…";
            if (!*c) break;
        } else {
            says_something |= std::isalpha(static_cast<unsigned char>(*c)) != 0;
            text += *c;
            if ((*c == '{' || *c == '}') && c[1] == *c) ++c;
        }
    }
    if (says_something) return text;
    std::string_view first = info.explanation;
    return std::string(first.substr(0, first.find(". ")));
}

std::string rules_text() {
    std::string text;
    for (const FindingInfo* row : validate_rules())
        text += fmt::format("{:<28} {:<8} {}\n", row->code, severity_name(row->severity),
                            rule_text(*row));
    return text;
}

std::string rules_json() {
    std::string text = "[";
    for (const FindingInfo* row : validate_rules())
        text += fmt::format(
            "{}\n{{\"code\": {}, \"severity\": {}, \"rendering\": {}, \"text\": {}, "
            "\"explanation\": {}, "
            "\"fix\": {}}}",
            row == validate_rules().front() ? "" : ",", json_string(row->code),
            json_string(severity_name(row->severity)), json_string(severity_name(row->rendering)),
            json_string(rule_text(*row)), json_string(row->explanation), json_string(row->fix));
    return text + "\n]\n";
}

std::string explain_text(const FindingInfo& info) {
    std::string rendering = info.rendering == info.severity
                                ? ""
                                : fmt::format("; {} when rendering", severity_name(info.rendering));
    std::string text = fmt::format("{} ({}{})\n    {}\n", info.code, severity_name(info.severity),
                                   rendering, rule_text(info));
    if (*info.explanation) text += fmt::format("\n{}\n", info.explanation);
    if (*info.fix) text += fmt::format("\nTo fix it: {}.\n", info.fix);
    return text;
}

}  // namespace kinora
