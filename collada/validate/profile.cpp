// collada/validate/profile.cpp: which codes are departures from the schema.
#include "collada/validate/profile.h"

#include "collada/document/findings.h"

namespace kinora::collada {

namespace {

// Codes about what the schema and XML prescribe.
constexpr std::string_view kSchemaGroups[] = {"XML_", "DOC_", "SCHEMA_", "ID_", "SID_BAD_CHAR"};

// Among them those that no schema forbids. An id that breaks the XSD is ID_NOT_NCNAME.
constexpr std::string_view kNoDeparture[] = {"DOC_OLD_VERSION", "SCHEMA_FOREIGN", "ID_BAD_CHAR"};

// Warnings of these are remarks, not deviations from what the specification asks.
constexpr std::string_view kRemarks[] = {"INFO_", "PORT_"};

template <size_t N>
bool starts_with_any(std::string_view code, const std::string_view (&prefixes)[N]) {
    for (std::string_view prefix : prefixes)
        if (code.starts_with(prefix)) return true;
    return false;
}

Severity strict_severity(std::string_view code, Severity severity) {
    if (starts_with_any(code, kNoDeparture)) return severity;
    if (starts_with_any(code, kSchemaGroups)) return Severity::Error;
    return severity == Severity::Warning && !starts_with_any(code, kRemarks) ? Severity::Error
                                                                             : severity;
}

}  // namespace

Severity profile_severity(const FindingInfo& info, Severity severity, Profile profile) {
    std::string_view code = info.code;
    if (severity == Severity::Off) return severity;
    if (profile == Profile::Strict) return strict_severity(code, severity);
    bool quiet = severity == Severity::Hint || code.starts_with("PORT_");
    return profile == Profile::Lenient && quiet ? Severity::Off : severity;
}

void judge_by_profile(Document& document, Profile profile, Diagnostics& diag) {
    if (profile != Profile::V1_4_1 && profile != Profile::V1_5) return;
    bool wants_15 = profile == Profile::V1_5, is_15 = document.version() == Version::V1_5_0;
    if (wants_15 == is_15) return;
    document.judge_as(wants_15 ? Version::V1_5_0 : Version::V1_4_1);
    diag.report(Code::DOC_NAMESPACE, document.location(document.root(), "xmlns"),
                document.root().value("xmlns"), wants_15 ? "1.5.0" : "1.4.1");
}

}  // namespace kinora::collada
