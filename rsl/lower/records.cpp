// rsl/lower/records.cpp: records of sets.
#include "rsl/lower/records.h"

#include <algorithm>

#include "rsl/directions/direction.h"

namespace kinora::rsl {

Value record_field(jit::Builder& b, Value set, Value record, int column, jit::Type type) {
    return b.op(jit::Op::RecordField, set, record, jit::kNone, column, int(type));
}
V3 record_triple(jit::Builder& b, Value set, Value record, int column) {
    return {record_field(b, set, record, column), record_field(b, set, record, column + 1),
            record_field(b, set, record, column + 2)};
}
Value record_uniform(jit::Builder& b, Value set, Value record, int field, jit::Type type) {
    return b.op(jit::Op::RecordUniform, set, record, jit::kNone, field, int(type));
}

// Set 0 holds the lights at the grid's own P; any other position asks the service once.
Value LightRecords::set_at(const V3& position) {
    if (is_input(b_, position, Global::P)) {
        context_.out.uses_lights = true;
        return b_.i(0);
    }
    return services_.call(Service::lights, position)[0];
}

namespace {

LitSide side_about(jit::Builder& b, const V3& axis) {
    const Direction d = direction_of(b, axis);
    if (d.base != Base::N) return kLitAround;
    if (d.faced == Base::None) return d.opposite ? kLitBehindN : kLitN;
    if (d.faced == Base::N) return d.opposite ? kLitAvertedByN : kLitFacingByN;
    return d.opposite ? kLitAverted : kLitFacing;
}

}  // namespace

void LightRecords::look_about(Value set, const V3* axis) {
    int32_t known;
    if (!b_.constant_i(set, &known) || known != 0) return;  // lights at other points
    context_.out.lit_sides |= axis ? side_about(b_, *axis) : kLitAround;
}

// The column of a light's parameter, and its number among the messages. The type that the first
// reader wants is kept.
int LightRecords::message_column(std::string_view name, Type type, int* index) {
    int column = kLightMessages;
    int components = component_count(type.base) * std::max(type.array_length, 1);
    bool text = type.base == BaseType::String;
    for (size_t k = 0; k < context_.out.light_messages.size(); ++k) {
        *index = int(k);
        Type known = context_.out.light_message_types[k];
        if (context_.out.light_messages[k] == name &&
            context_.out.light_message_components[k] == components &&
            known.array_length == type.array_length && (known.base == BaseType::String) == text)
            return column;
        column += context_.out.light_message_components[k];
    }
    *index = int(context_.out.light_messages.size());
    context_.out.light_messages.emplace_back(name);
    context_.out.light_message_components.push_back(components);
    context_.out.light_message_types.push_back(type);
    return column;
}

// __nondiffuse and __nonspecular are uniforms of every record.
std::vector<Lowered> LightRecords::message(const std::string& name, Type type,
                                           std::span<const Lowered> before, Value* known) {
    auto [set, record] = state_;
    if (type == Type{BaseType::Float, -1} && (name == "__nondiffuse" || name == "__nonspecular")) {
        int field = name == "__nondiffuse" ? kLightNondiffuse : kLightNonspecular;
        *known = b_.m(true);
        return {lowered(BaseType::Float, record_uniform(b_, set, record, field, jit::Type::F))};
    }
    int message;
    int column = message_column(name, type, &message);
    Value has = record_uniform(b_, set, record, kLightUniforms + message, jit::Type::I);
    *known = b_.logical_not(b_.op(jit::Op::IEq, has, b_.i(0)));
    jit::Type read_as = type.base == BaseType::String ? jit::Type::I : jit::Type::F;
    std::vector<Lowered> values(before.begin(), before.end());
    for (Lowered& value : values)
        for (size_t c = 0; c < size_t(value.size()); ++c)
            value.c[c] =
                b_.select(*known, record_field(b_, set, record, column++, read_as), value.c[c]);
    return values;
}

// "name" asks for lights of the category, "-name" for all others, "" for all. What an expression
// ("a|b", "a&-b") means is the renderer's to say once (kLightCategories).
Value LightRecords::category_matches(Value set, Value record, Value category, Location where) {
    const std::string* text = e_.constant_text(category);
    if (!text) {
        context_.error(Code::RSL_STRING_NOT_CONSTANT, where, "illuminance");
        return b_.m(true);
    }
    if (text->empty()) {
        context_.out.lit_by_all = true;
        return b_.m(true);
    }
    bool without = text->front() == '-' && text->find_first_of("|&") == std::string::npos;
    std::string name = text->substr(without ? 1 : 0);
    auto found = std::find(context_.out.categories.begin(), context_.out.categories.end(), name);
    if (found == context_.out.categories.end() && context_.out.categories.size() == 32)
        context_.error(Code::RSL_TOO_MANY_CATEGORIES, where, 32);
    int bit = int(found - context_.out.categories.begin());
    if (found == context_.out.categories.end()) context_.out.categories.push_back(name);
    (without ? context_.out.lit_without : context_.out.lit_categories) |= 1u << (bit & 31);
    Value bits = record_uniform(b_, set, record, kLightCategories, jit::Type::I);
    Value absent = b_.op(jit::Op::IEq, b_.iand(bits, b_.i(int32_t(1u << (bit & 31)))), b_.i(0));
    return without ? absent : b_.logical_not(absent);
}

}  // namespace kinora::rsl
