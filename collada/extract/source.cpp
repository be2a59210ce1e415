// collada/extract/source.cpp: <source>: an array and the accessor that cuts it into entries.
#include <cmath>

#include "collada/document/element_numbers_p.h"
#include "collada/extract/extract_p.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

const Element* find_input(const Element& parent, std::string_view semantic) {
    for (const Element& child : parent.children())
        if (child.name == "input" && child.value("semantic") == semantic) return &child;
    return nullptr;
}

namespace {

constexpr std::string_view kNumberArrays[] = {"float_array", "int_array"};
constexpr std::string_view kNameArrays[] = {"Name_array", "IDREF_array", "SIDREF_array"};

const Element* find_accessor(const Element& source) {
    const Element* common = source.child("technique_common");
    return common ? common->child("accessor") : nullptr;
}

// The array of a source: that its accessor names, else the one it holds.
template <size_t N>
const Element* find_array(Extraction& x, Link source, const std::string_view (&names)[N]) {
    const Element* accessor = find_accessor(*source.element);
    std::string_view url = accessor ? accessor->value("source") : std::string_view{};
    if (url.starts_with('#'))
        for (std::string_view name : names)
            if (const Element* array = find_kind(x.document(source.doc), url.substr(1), {name}))
                return array;
    for (std::string_view name : names)
        if (const Element* array = source.element->child(name)) return array;
    return nullptr;
}

// Nothing where the attribute is not there, or is no count, which is reported.
std::optional<uint64_t> read_count(Extraction& x, Link link, std::string_view attribute) {
    const Attribute* a = link.element->attribute(attribute);
    if (!a) return std::nullopt;
    uint64_t value = 0;
    if (parse_count(a->value, value)) return value;
    x.diag.report(Code::SRC_ATTRIBUTE, x.where(link, attribute), attribute, link.element->name,
                  fmt::format("is '{}'", a->value));
    return std::nullopt;
}

void report_missing(Extraction& x, Link link, std::string_view attribute) {
    if (!link.element->attribute(attribute))
        x.diag.report(Code::SRC_ATTRIBUTE, x.where(link), attribute, link.element->name,
                      "is missing");
}

void check_array_count(Extraction& x, Link array, size_t values) {
    report_missing(x, array, "count");
    uint64_t count = read_count(x, array, "count").value_or(values);
    if (count != values) x.diag.report(Code::SRC_COUNT, x.where(array, "count"), count, values);
}

// How many numbers of the array one <param> covers: "float4x4" is 16, "float3" 3, others 1.
uint32_t param_width(std::string_view type) {
    if (!type.starts_with("float") && !type.starts_with("double") && !type.starts_with("int"))
        return 1;
    size_t digit = type.find_first_of("234");
    if (digit == type.npos) return 1;
    uint32_t width = uint32_t(type[digit] - '0');
    bool matrix = digit + 2 < type.size() && type[digit + 1] == 'x';
    if (matrix && type[digit + 2] >= '2' && type[digit + 2] <= '4')
        width *= uint32_t(type[digit + 2] - '0');
    return width;
}

// The columns of named <param>s; unnamed ones are skipped by the specification, unless all are.
void read_columns(const Element& accessor, SourceView& view) {
    constexpr uint32_t kMaxColumns = 4096;
    uint32_t column = 0, params = 0;
    for (const Element& child : accessor.children()) {
        if (child.name != "param" || column >= kMaxColumns) continue;
        uint32_t width = param_width(child.value("type"));
        for (uint32_t i = 0; i < width && child.attribute("name"); ++i)
            view.columns.push_back(column + i);
        column += width;
        ++params;
    }
    bool none_named = view.columns.empty();
    // Some exporters give a matrix one param of type float.
    bool matrix = params == 1 && column == 1 && accessor.value("stride") == "16";
    if (!none_named && !matrix) return;
    view.columns.clear();
    for (uint32_t i = 0; i < (matrix ? 16 : column); ++i) view.columns.push_back(i);
}

}  // namespace

uint64_t accessor_width(const Element& accessor) {
    SourceView view;
    read_columns(accessor, view);
    return view.columns.empty() ? 1 : view.columns.back() + 1;
}

bool read_accessor(Extraction& x, Link source, size_t array_length, SourceView& view) {
    const Element* element = find_accessor(*source.element);
    if (!element) {
        x.diag.report(Code::SRC_EMPTY, x.where(source), source.element->value("id"));
        return false;
    }
    Link accessor{source.doc, element};
    view.source = source;
    read_columns(*element, view);
    uint64_t stride = read_count(x, accessor, "stride").value_or(1);
    uint64_t needed = view.columns.empty() ? 1 : view.columns.back() + 1;
    uint64_t offset = read_count(x, accessor, "offset").value_or(0);
    uint64_t room = offset < array_length ? array_length - offset : 0;
    // Blender gives the single numbers of a camera's key three <param>s: the array tells.
    std::optional<uint64_t> said = read_count(x, accessor, "count");
    report_missing(x, accessor, "count");
    report_missing(x, accessor, "source");
    bool array_fits =
        stride > 0 && said && *said > 0 && *said == room / stride && room % stride == 0;
    if (stride < needed && !element->attribute("stride"))
        report_missing(x, accessor, "stride");
    else if (stride < needed && array_fits)
        x.diag.report(Code::SRC_PARAM, x.where(accessor, "stride"),
                      fmt::format("stride is {}, the <param>s ask for {}", stride, needed));
    else if (stride < needed)
        x.diag.report(Code::SRC_STRIDE, x.where(accessor, "stride"), stride, needed);
    if (element->attribute("stride") && stride < needed && array_fits)
        std::erase_if(view.columns, [&](uint32_t c) { return c >= stride; });
    else
        stride = std::max(stride, needed);
    if (view.columns.empty())
        for (uint32_t i = 0; i < std::min<uint64_t>(stride, 4096); ++i) view.columns.push_back(i);
    if (offset > 0 && offset >= array_length)
        x.diag.report(Code::SRC_OFFSET, x.where(accessor, "offset"), offset, array_length);
    uint64_t held = room / stride;
    uint64_t count = said.value_or(held);
    uint64_t reach = 0;
    if (__builtin_mul_overflow(count, stride, &reach) ||
        __builtin_add_overflow(reach, offset, &reach)) {
        x.diag.report(Code::SRC_OVERFLOW, x.where(accessor));
        return false;
    }
    if (count > held) {
        x.diag.report(Code::SRC_ACCESSOR_COUNT, x.where(accessor, "count"), count, held);
        count = held;
    }
    view.stride = uint32_t(view.columns.size());
    view.count = size_t(count);
    view.offset = size_t(offset);
    view.array_stride = size_t(stride);
    return true;
}

DoubleSource read_double_source(Extraction& x, Link source) {
    DoubleSource out;
    const Element* array = find_array(x, source, kNumberArrays);
    if (!array) {
        x.diag.report(Code::SRC_EMPTY, x.where(source), source.element->value("id"));
        return out;
    }
    if (!x.budget.reserve_parsing(array->text.size(), x.where({source.doc, array}))) return out;
    std::vector<double> values =
        read_doubles(x.document(source.doc), *array, x.diag, written_count(*array));
    if (x.options.everything) x.read_arrays.insert(array);
    check_array_count(x, {source.doc, array}, values.size());
    SourceView view;
    if (!read_accessor(x, source, values.size(), view)) return out;
    out.stride = view.stride;
    out.count = view.count;
    bool dense = view.offset == 0 && view.array_stride == view.stride;
    if (dense) {
        values.resize(view.count * view.stride);
        out.values = std::move(values);
        return out;
    }
    out.values.reserve(view.count * view.stride);
    for (size_t i = 0; i < view.count; ++i)
        for (uint32_t column : view.columns)
            out.values.push_back(values[view.offset + i * view.array_stride + column]);
    return out;
}

NameSource read_name_source(Extraction& x, Link source) {
    NameSource out;
    out.array = find_array(x, source, kNameArrays);
    if (!out.array) {
        x.diag.report(Code::SRC_EMPTY, x.where(source), source.element->value("id"));
        return out;
    }
    if (out.array->name == "IDREF_array") out.kind = JointNames::Idref;
    if (out.array->name == "SIDREF_array") out.kind = JointNames::Sidref;
    if (!x.budget.reserve_parsing(out.array->text.size(), x.where({source.doc, out.array})))
        return out;
    out.written_count = read_count(x, {source.doc, out.array}, "count").value_or(0);
    out.names = split_words(out.array->text);
    return out;
}

}  // namespace kinora::collada
