// runtime/scene/ri/state/call_content.cpp: hashes of calls.
#include "runtime/scene/ri/state/call_content.h"

#include "runtime/base/files/content_hash.h"

namespace kinora::ri {
namespace {

template <class T>
void add(ContentHash& hash, const T& number) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    hash.add(&number, sizeof number);
}

template <class T>
void add_all(ContentHash& hash, std::span<const T> numbers) {
    add(hash, numbers.size());
    hash.add(numbers.data(), numbers.size_bytes());
}

void add(ContentHash& hash, const Values& values) {
    add(hash, values.kind());
    add_all(hash, values.integers());
    add_all(hash, values.floats());
    for (const char* text : values.strings()) hash.add_text(text ? text : "");
}

void add(ContentHash& hash, const Basis& basis) {
    hash.add(&basis.matrix[0][0], sizeof basis.matrix);
    add(hash, basis.step);
}

}  // namespace

uint64_t content_of(const Call& call, const Attributes& attributes) {
    ContentHash hash;
    add(hash, call.request);
    for (const Values& values : call.arguments) add(hash, values);
    for (const Parameter& parameter : call.parameters) {
        hash.add_text(parameter.name);
        add(hash, parameter.declaration.storage);
        add(hash, parameter.declaration.type);
        add(hash, parameter.declaration.array);
        add(hash, parameter.values);
    }
    add_all(hash, std::span<const double>(attributes.corners));
    add(hash, attributes.inside_out);
    add(hash, attributes.u);
    add(hash, attributes.v);
    add(hash, attributes.trim_outside);
    for (const TrimLoop& loop : attributes.trims) add_all(hash, std::span<const dvec2>(loop));
    return hash.value();
}

}  // namespace kinora::ri
