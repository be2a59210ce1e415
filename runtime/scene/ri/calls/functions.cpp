// runtime/scene/ri/calls/functions.cpp: what the C functions share.
#include <algorithm>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/ri/calls/functions_p.h"
#include "runtime/scene/ri/calls/outside.h"

namespace kinora::ri {

Pairs::Pairs(va_list list) {
    while (RtToken token = va_arg(list, RtToken)) {
        tokens.push_back(token);
        values.push_back(va_arg(list, RtPointer));
    }
}

void tell_not_started() {
    outside().context.error(Code::RI_NOT_STARTED);
}

void tell_missing(Request request, const char* what) {
    Context* context = Context::current();
    if (!context) return tell_not_started();
    context->error(Code::RI_DATA_MISSING, row(request).name, what);
}

Context& current_or_outside() {
    Context* context = Context::current();
    return context ? *context : outside().context;
}

void send(Request request, std::initializer_list<Values> arguments, RtInt n, RtToken tokens[],
          RtPointer values[], RtInt vertices) {
    Context* context = Context::current();
    if (!context) return tell_not_started();
    context->send(request, {arguments.begin(), arguments.size()}, n, tokens, values,
                  uint32_t(std::max(vertices, 0)));
}

RtPointer send_new(Request request, std::vector<Values> arguments, size_t at, RtInt n,
                   RtToken tokens[], RtPointer values[]) {
    Context* context = Context::current();
    if (!context) {
        tell_not_started();
        return nullptr;
    }
    RtPointer handle = context->new_handle();
    arguments.insert(arguments.begin() + std::ptrdiff_t(at), context->handle_number(handle));
    context->send(request, arguments, n, tokens, values);
    return handle;
}

void send_handle(Request request, RtPointer handle, std::initializer_list<Values> others) {
    Context* context = Context::current();
    if (!context) return tell_not_started();
    int number = context->handle_number(handle);
    if (!number) return context->error(Code::RI_HANDLE, row(request).name);
    std::vector<Values> arguments = {number};
    arguments.insert(arguments.end(), others);
    context->send(request, arguments, 0, nullptr, nullptr);
}

int64_t total(std::span<const int> counts) {
    int64_t sum = 0;
    for (int count : counts) sum += std::max(count, 0);
    return sum;
}

}  // namespace kinora::ri
