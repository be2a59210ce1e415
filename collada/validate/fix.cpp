// collada/validate/fix.cpp: which code is repaired by what; rounds of repairs until none is left.
#include "collada/validate/fix.h"

#include <algorithm>
#include <set>
#include <utility>

#include "collada/text/encoding_p.h"
#include "collada/validate/fix_p.h"

namespace kinora::collada {

namespace {

using Wanted = bool (*)(const FindingInfo&, const void*);

struct Fixer {
    const FindingInfo* info;
    void (*fix)(FixContext&);
};

// Those that change little come first: of two edits of the same bytes the first one is made, the
// other in the next round.
const std::vector<Fixer>& fixers() {
    static const std::vector<Fixer> kFixers = {
        {&Code::SRC_COMMA_DECIMAL, fix_comma_decimals},
        {&Code::SRC_COUNT, fix_array_count},
        {&Code::SRC_STRIDE, fix_accessor_stride},
        {&Code::SRC_ATTRIBUTE, fix_accessor_stride},
        {&Code::SRC_ACCESSOR_COUNT, fix_accessor_count},
        {&Code::PRIM_COUNT, fix_primitive_count},
        {&Code::LINK_NO_HASH, fix_missing_hash},
        {&Code::SRC_NO_HASH, fix_missing_hash},
        {&Code::SCHEMA_PATTERN, fix_missing_hash},
        {&Code::FILE_BACKSLASH, fix_path},
        {&Code::FILE_ABSOLUTE, fix_path},
        {&Code::FILE_HOST, fix_path},
        {&Code::FILE_SPACE, fix_path},
        {&Code::FILE_CASE, fix_path},
        {&Code::FILE_FALLBACK, fix_path},
        {&Code::SCHEMA_EMPTY_LIBRARY, fix_empty_libraries},
        {&Code::SCHEMA_ORDER, fix_order},
        {&Code::UPAXIS_SPELLING, fix_up_axis},
    };
    return kFixers;
}

// What the reader mends in the text itself.
constexpr const FindingInfo* kMendedByReading[] = {&Code::XML_AMPERSAND, &Code::XML_DECLARATION};

// Elements nest, and an element that moves takes its own disorder along: a round a level.
constexpr int kMostRounds = 64;

struct Round {
    std::vector<Edit> edits;
    std::vector<FixCount> counts;
    std::set<std::pair<uint32_t, uint32_t>> ranges;  // one is repaired by one code
};

Round find_fixes(const Document& document, const Diagnostics& diagnostics, const SceneData* scene,
                 const std::vector<const Fixer*>& wanted) {
    ElementIndex elements(document);
    Round round;
    for (const Fixer* fixer : wanted) {
        FixContext context{document, diagnostics.files.text(document.file()), scene, elements, {},
                           {}};
        for (const Finding& finding : diagnostics.findings())
            if (finding.info == fixer->info && finding.where.file == document.file())
                context.findings.push_back(&finding);
        if (context.findings.empty()) continue;
        fixer->fix(context);
        size_t made = 0;
        for (Edit& edit : context.edits) {
            if (!round.ranges.emplace(edit.bytes.begin, edit.bytes.end).second) continue;
            round.edits.push_back(std::move(edit));
            ++made;
        }
        if (made) round.counts.push_back({fixer->info, made});
    }
    return round;
}

void add_counts(std::vector<FixCount>& sum, const std::vector<FixCount>& counts) {
    for (const FixCount& one : counts) {
        auto known = std::find_if(sum.begin(), sum.end(),
                                  [&](const FixCount& c) { return c.info == one.info; });
        if (known == sum.end())
            sum.push_back(one);
        else
            known->count += one.count;
    }
}

bool is_recoded(std::string_view bytes) {
    return bytes.starts_with("\xef\xbb\xbf") || !valid_utf8(bytes);
}

std::vector<FixCount> mended_by_reading(const Diagnostics& diagnostics, Wanted wanted,
                                        const void* context) {
    std::vector<FixCount> counts;
    for (const FindingInfo* info : kMendedByReading) {
        auto count = std::ranges::count(diagnostics.findings(), info, &Finding::info);
        if (count > 0 && wanted(*info, context)) counts.push_back({info, size_t(count)});
    }
    return counts;
}

}  // namespace

FixResult fix_text(const std::string& path, std::string text, const ValidateOptions& options,
                   bool (*wanted)(const FindingInfo&, const void*), const void* context) {
    FixResult result{std::move(text), {}, {}};
    std::string original;
    std::vector<const Fixer*> chosen;
    for (const Fixer& fixer : fixers())
        if (wanted(*fixer.info, context)) chosen.push_back(&fixer);
    for (int round = 0; round < kMostRounds; ++round) {
        Diagnostics diagnostics;
        std::optional<Document> document = read_document_text(path, result.text, diagnostics);
        if (!document || !document->whole()) break;
        if (std::string_view decoded = diagnostics.files.text(document->file());
            decoded != result.text) {
            if (!original.empty()) break;
            original = std::exchange(result.text, declared_utf8(decoded));
            if (is_recoded(original)) result.recoded = decoded;
            add_counts(result.fixes, mended_by_reading(diagnostics, wanted, context));
            continue;
        }
        std::optional<SceneData> scene = validate(*document, diagnostics, options);
        Round fixes = find_fixes(*document, diagnostics, scene ? &*scene : nullptr, chosen);
        if (fixes.edits.empty()) break;
        std::string next = apply_edits(result.text, fixes.edits);
        if (next == result.text) break;
        result.text = std::move(next);
        add_counts(result.fixes, fixes.counts);
    }
    if (result.fixes.empty() && !original.empty()) {  // nothing to repair is nothing to rewrite
        result.text = std::move(original);
        result.recoded.clear();
    }
    return result;
}

std::vector<const FindingInfo*> fixable_findings() {
    std::vector<const FindingInfo*> list;
    for (const Fixer& fixer : fixers()) list.push_back(fixer.info);
    list.insert(list.end(), std::begin(kMendedByReading), std::end(kMendedByReading));
    return list;
}

}  // namespace kinora::collada
