// collada/validate/lint_sources.cpp: sources that no reader asked for, arrays of names, and what an
// input expects of its source's <param>s.
#include "collada/text/numbers_p.h"
#include "collada/validate/lint_p.h"

namespace kinora::collada {

namespace {

const Element* accessor_of(const Element& source) {
    const Element* common = source.child("technique_common");
    return common ? common->child("accessor") : nullptr;
}

// The array that the accessor names, else the one inside.
const Element* array_of(const Lint& lint, const Element& source) {
    const Element* accessor = accessor_of(source);
    std::string_view url = accessor ? accessor->value("source") : std::string_view{};
    const Element* named = url.starts_with('#') ? lint.document.find(url.substr(1)) : nullptr;
    if (named && named->name.ends_with("_array")) return named;
    for (const Element& child : source.children())
        if (child.name.ends_with("_array")) return &child;
    return nullptr;
}

bool is_word_array(std::string_view name) {
    return name == "Name_array" || name == "IDREF_array" || name == "SIDREF_array" ||
           name == "token_array" || name == "bool_array";
}

// Joint names with spaces count as more words than names; the skin's reader joins them again.
bool names_joints(const Element& source) {
    return source.parent && source.parent->name == "skin";
}

void check_words(Lint& lint, const Element& source, const Element& array) {
    size_t words = split_words(array.text).size();
    uint64_t count = 0;
    bool given = parse_count(array.value("count"), count);
    if (given && count != words && !(count < words && names_joints(source)))
        lint.diag.report(Code::SRC_COUNT, lint.where(array, "count"), count, words);
    SourceView view;
    if (accessor_of(source)) read_accessor(lint.x, {0, &source}, words, view);
}

// Numbers and accessors that extract parsed are checked already.
void check_source(Lint& lint, const Element& source) {
    const Element* array = array_of(lint, source);
    if (!array) return;
    if (is_word_array(array->name))
        check_words(lint, source, *array);
    else if (!lint.x.read_arrays.count(array))
        read_double_source(lint.x, {0, &source});
}

// The fewest values of an entry that the semantic makes sense with.
struct WidthRow {
    std::string_view semantic;
    uint32_t least;
};
constexpr WidthRow kWidths[] = {
    {"POSITION", 3},    {"NORMAL", 3}, {"TANGENT", 3},  {"BINORMAL", 3}, {"TEXTANGENT", 3},
    {"TEXBINORMAL", 3}, {"COLOR", 3},  {"TEXCOORD", 1}, {"UV", 2},       {"INV_BIND_MATRIX", 16}};

using Widths = std::unordered_map<const Element*, uint32_t>;

// The values of an entry that the accessor gives, 0 if it cannot be read; once a source.
uint32_t width_of(Lint& lint, const Element& source, Widths& widths) {
    auto [at, fresh] = widths.try_emplace(&source, 0);
    SourceView view;
    constexpr size_t kAnyLength = SIZE_MAX / 2;  // the array's length was checked already
    if (fresh && accessor_of(source) && read_accessor(lint.x, {0, &source}, kAnyLength, view))
        at->second = view.stride;
    return at->second;
}

void check_width(Lint& lint, const Element& input, Widths& widths) {
    std::string_view url = input.value("source");
    if (!url.starts_with('#')) return;
    const Element* source = find_kind(lint.document, url.substr(1), {"source"});
    uint32_t width = source ? width_of(lint, *source, widths) : 0;
    if (width == 0) return;
    for (const WidthRow& row : kWidths) {
        if (row.semantic != input.value("semantic")) continue;
        if (width < row.least)
            lint.diag.report(Code::SRC_PARAM, lint.where(*accessor_of(*source)),
                             fmt::format("{} wants {} values an entry, the <param>s name {}",
                                         row.semantic, row.least, width));
    }
}

}  // namespace

void lint_sources(Lint& lint) {
    for (const Element* source : lint.named("source"))
        if (source->parent && source->attribute("id")) check_source(lint, *source);
    Widths widths;
    for (const Element* input : lint.named("input")) check_width(lint, *input, widths);
}

}  // namespace kinora::collada
