// runtime/scene/ri/calls/call.h: a call of the interface as a value. C functions make it, sinks
// take it: one renders, one writes RIB, one records.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "runtime/base/diagnostic.h"
#include "runtime/scene/ri/calls/declaration.h"

namespace kinora::ri {

enum class Request : uint8_t {
#define REQUEST(name, arguments, class) name,
#include "runtime/scene/ri/calls/requests.def"
#undef REQUEST
};

enum class RequestClass : uint8_t { Anywhere, Block, Option, Attribute, Transform, Primitive, Map };

struct RequestRow {
    std::string_view name;       // "Sphere"; the function is RiSphere
    std::string_view arguments;  // requests.def explains
    RequestClass kind;

    bool has_parameters() const { return arguments.ends_with('*'); }
};
std::span<const RequestRow> requests();
inline const RequestRow& row(Request request) {
    return requests()[size_t(request)];
}
const Request* find_request(std::string_view name);  // null: there is none

// An argument, or the values of a parameter: one number, string or function of the program's, or an
// array of the first two. Memory is the caller's.
class Values {
  public:
    enum class Kind : uint8_t { Integers, Floats, Strings, Function };

    Values() : Values(std::span<const float>()) {}
    Values(int value) : kind_(Kind::Integers), count_(1) { one_.integer = value; }
    Values(float value) : kind_(Kind::Floats), count_(1) { one_.real = value; }
    Values(const char* value) : kind_(Kind::Strings), count_(1) {
        one_.string = value ? value : "";
    }
    Values(void (*callback)()) : kind_(Kind::Function), count_(1) { one_.function = callback; }
    Values(std::span<const int> values) : Values(Kind::Integers, values.data(), values.size()) {}
    Values(std::span<const float> values) : Values(Kind::Floats, values.data(), values.size()) {}
    Values(std::span<const char* const> values)
        : Values(Kind::Strings, values.data(), values.size()) {}

    Kind kind() const { return kind_; }
    bool is_array() const { return array_; }
    size_t size() const { return count_; }
    // Of the kind that it is; else empty.
    std::span<const int> integers() const { return all<int>(Kind::Integers, &one_.integer); }
    std::span<const float> floats() const { return all<float>(Kind::Floats, &one_.real); }
    std::span<const char* const> strings() const {
        return all<const char*>(Kind::Strings, &one_.string);
    }
    // The first; 0 or "" where there is none.
    int integer() const { return integers().empty() ? 0 : integers()[0]; }
    float real() const { return floats().empty() ? 0 : floats()[0]; }
    std::string_view string() const { return strings().empty() ? "" : strings()[0]; }
    void (*function() const)() { return kind_ == Kind::Function ? one_.function : nullptr; }

  private:
    Values(Kind kind, const void* many, size_t count)
        : kind_(kind), array_(true), count_(uint32_t(count)) {
        one_.many = many;
    }
    template <class T>
    std::span<const T> all(Kind kind, const T* one) const {
        if (kind != kind_) return {};
        return {array_ ? static_cast<const T*>(one_.many) : one, count_};
    }

    Kind kind_;
    bool array_ = false;
    uint32_t count_;
    union {
        int integer;
        float real;
        const char* string;
        void (*function)();
        const void* many;
    } one_;
};

// A token of a parameter list with its values, as many as its declaration and the call's counts
// ask.
struct Parameter {
    std::string_view name;  // without an inline declaration
    Declaration declaration;
    Values values;
};

// How many values a variable of each class has.
struct Counts {
    uint32_t uniform = 1, varying = 1, vertex = 1, face_varying = 1;

    uint32_t of(StorageClass storage) const;
};

// The name of the shader that a request's parameters are for; "": there is none.
std::string_view shader_of(Request request, std::span<const Values> arguments);

// How many steps a basis takes between patches, and how many numbers a colour has: what the counts
// of values depend on. An attribute, and an option.
struct CountState {
    int ustep = 3, vstep = 3;
    uint32_t color_samples = 3;
};

struct Call {
    Request request;
    std::span<const Values> arguments;  // as row(request).arguments has them
    std::span<const Parameter> parameters;
    Counts counts;
    Location where;  // of the request in its file, if it was read from one

    const Parameter* find(std::string_view name) const {
        for (const Parameter& parameter : parameters)
            if (parameter.name == name) return &parameter;
        return nullptr;
    }
};

// Takes the calls of a context.
class CallSink {
  public:
    virtual ~CallSink() = default;
    virtual void call(const Call& call) = 0;
    // Of a token that nobody declared: as a shader that is asked for, or is there, has it. Null: it
    // is not known.
    virtual const Declaration* declared_by_shader(Request request, std::string_view shader,
                                                  std::string_view token) {
        (void)request, (void)shader, (void)token;
        return nullptr;
    }
    // What the calls so far came to; nothing: the sink does not know, or keeps what comes.
    virtual std::optional<CountState> count_state() { return std::nullopt; }
    // RiTransformPoints; false: one of the spaces is not known.
    virtual bool transform_points(std::string_view from, std::string_view to,
                                  std::span<float> points) {
        (void)from, (void)to, (void)points;
        return false;
    }
};

}  // namespace kinora::ri
