// runtime/scene/ri/calls/functions_p.h: what the C functions share.
#pragma once

#include <cstdarg>
#include <initializer_list>
#include <span>
#include <vector>

#include "runtime/scene/ri/calls/call.h"
#include "runtime/scene/ri/calls/context.h"
#include "runtime/scene/ri/calls/ri.h"

namespace kinora::ri {

// The (token, pointer) pairs of a call.
struct Pairs {
    std::vector<RtToken> tokens;
    std::vector<RtPointer> values;

    explicit Pairs(va_list list);
    RtInt count() const { return RtInt(tokens.size()); }
};

// No context was begun on this thread: RIE_NOTSTARTED.
void tell_not_started();
// Of a null pointer: RIE_MISSINGDATA.
void tell_missing(Request request, const char* what);
// The context of this thread, or that of calls which need none.
Context& current_or_outside();

void send(Request request, std::initializer_list<Values> arguments, RtInt n = 0,
          RtToken tokens[] = nullptr, RtPointer values[] = nullptr, RtInt vertices = 0);

// Sends a call that makes something, and returns its handle: its number stands at argument `at`.
RtPointer send_new(Request request, std::vector<Values> arguments, size_t at, RtInt n = 0,
                   RtToken tokens[] = nullptr, RtPointer values[] = nullptr);

// A handle that this context has not given is RIE_BADHANDLE.
void send_handle(Request request, RtPointer handle, std::initializer_list<Values> others = {});

// The name that RIB has for a filter of the interface; else the function.
Values filter_values(RtFilterFunc filter);  // filter_function() (context.h) is its inverse

// Arrays of a C call; of no length where the pointer is null or the number negative.
inline std::span<const int> array(const RtInt* values, int64_t count) {
    return {values, values && count > 0 ? size_t(count) : 0};
}
inline std::span<const float> array(const RtFloat* values, int64_t count) {
    return {values, values && count > 0 ? size_t(count) : 0};
}
inline std::span<const char* const> array(char* const* values, int64_t count) {
    return {values, values && count > 0 ? size_t(count) : 0};
}
inline std::span<const float> matrix(RtFloat (*rows)[4]) {
    return array(rows ? rows[0] : nullptr, 16);
}
// The sum, of those above 0.
int64_t total(std::span<const int> counts);

}  // namespace kinora::ri

// The last parameter before ... may be a float in this binding, which the C++ standard does not
// promise to work and GCC and Clang make work on our processors.
#pragma GCC diagnostic ignored "-Wvarargs"
#define KINORA_PAIRS(last)         \
    va_list list;                  \
    va_start(list, last);          \
    kinora::ri::Pairs pairs(list); \
    va_end(list)
