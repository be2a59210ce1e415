// runtime/programs/validate/rules.h: every code there is, for --list-rules, --explain and reports.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/diagnostic.h"

namespace kinora {

namespace Code {
using enum Severity;

#define FINDING(code, ...) inline constexpr FindingInfo code = finding_row(#code, __VA_ARGS__);
#include "runtime/programs/validate/findings.def"
#undef FINDING
}  // namespace Code

// Those that kinora-validate can report, by code, each once.
const std::vector<const FindingInfo*>& validate_rules();

// Of those, or of any that only the other programs report; null if there is none.
const FindingInfo* find_rule(std::string_view code);

// Its index in validate_rules(), if it is there.
std::optional<size_t> rule_index(const FindingInfo& info);

std::optional<Severity> parse_severity(std::string_view name);  // "off", "hint", ...

// The text with {} and the like as N: "'N' names no <N>".
std::string rule_text(const FindingInfo& info);

std::string rules_text();                           // --list-rules
std::string rules_json();                           // the same with --format json
std::string explain_text(const FindingInfo& info);  // --explain CODE

}  // namespace kinora
