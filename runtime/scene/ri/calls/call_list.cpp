// runtime/scene/ri/calls/call_list.cpp: copies of calls.
#include "runtime/scene/ri/calls/call_list.h"

#include <algorithm>
#include <cstring>

namespace kinora::ri {
namespace {

constexpr size_t kBlock = 64 * 1024;

template <class T>
std::span<const T> typed(const void* bytes, size_t count) {
    return {static_cast<const T*>(bytes), count};
}

}  // namespace

void* CallList::take(size_t count) {
    size_t room = (count + alignof(std::max_align_t) - 1) & ~(alignof(std::max_align_t) - 1);
    if (room > left_) {
        left_ = std::max(room, kBlock);
        blocks_.push_back(std::make_unique_for_overwrite<std::byte[]>(left_));
        next_ = blocks_.back().get();
    }
    void* taken = next_;
    next_ += room, left_ -= room;
    return taken;
}

void* CallList::store(const void* bytes, size_t count) {
    void* stored = take(count);
    if (count) std::memcpy(stored, bytes, count);
    return stored;
}

std::string_view CallList::store_text(std::string_view text) {
    char* stored = static_cast<char*>(take(text.size() + 1));
    std::copy(text.begin(), text.end(), stored);
    stored[text.size()] = 0;
    return {stored, text.size()};
}

Values CallList::store_values(const Values& values) {
    if (values.kind() == Values::Kind::Strings) {
        std::vector<const char*> stored;
        for (const char* text : values.strings())
            stored.push_back(store_text(text ? text : "").data());
        if (!values.is_array()) return stored[0];
        size_t bytes = stored.size() * sizeof(const char*);
        return typed<const char*>(store(stored.data(), bytes), stored.size());
    }
    if (!values.is_array()) return values;
    if (auto numbers = values.floats(); values.kind() == Values::Kind::Floats)
        return typed<float>(store(numbers.data(), numbers.size_bytes()), numbers.size());
    auto numbers = values.integers();
    return typed<int>(store(numbers.data(), numbers.size_bytes()), numbers.size());
}

void CallList::add(const Call& call) {
    std::vector<Values> arguments;
    for (const Values& values : call.arguments) arguments.push_back(store_values(values));
    std::vector<Parameter> parameters;
    for (const Parameter& parameter : call.parameters)
        parameters.push_back(
            {store_text(parameter.name), parameter.declaration, store_values(parameter.values)});
    Call kept = call;
    kept.arguments =
        typed<Values>(store(arguments.data(), arguments.size() * sizeof(Values)), arguments.size());
    kept.parameters = typed<Parameter>(
        store(parameters.data(), parameters.size() * sizeof(Parameter)), parameters.size());
    calls_.push_back(kept);
}

}  // namespace kinora::ri
