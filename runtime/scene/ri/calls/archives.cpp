// runtime/scene/ri/calls/archives.cpp: archives and conditions of ri.h.
#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/ri/calls/functions_p.h"

using namespace kinora::ri;
namespace Code = kinora::Code;

RtVoid RiReadArchive(RtToken name, RtArchiveCallback callback, ...) {
    KINORA_PAIRS(callback);
    RiReadArchiveV(name, callback, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtArchiveHandle RiArchiveBegin(RtToken name, ...) {
    KINORA_PAIRS(name);
    return RiArchiveBeginV(name, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiArchiveEnd() {
    send(Request::ArchiveEnd, {});
}

RtVoid RiIfBegin(char* expression, ...) {
    KINORA_PAIRS(expression);
    RiIfBeginV(expression, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiIfBeginV(char* expression, RtInt n, RtToken tokens[], RtPointer parms[]) {
    send(Request::IfBegin, {expression}, n, tokens, parms);
}

RtVoid RiElseIf(char* expression, ...) {
    KINORA_PAIRS(expression);
    RiElseIfV(expression, pairs.count(), pairs.tokens.data(), pairs.values.data());
}

RtVoid RiElseIfV(char* expression, RtInt n, RtToken tokens[], RtPointer parms[]) {
    send(Request::ElseIf, {expression}, n, tokens, parms);
}

RtVoid RiElse() {
    send(Request::Else, {});
}

RtVoid RiIfEnd() {
    send(Request::IfEnd, {});
}

RtVoid RiReadArchiveV(RtToken name, RtArchiveCallback callback, RtInt n, RtToken tokens[],
                      RtPointer parms[]) {
    Context* context = Context::current();
    if (!context) return tell_not_started();
    RtArchiveCallback outer = std::exchange(context->archive_callback, callback);
    context->send(Request::ReadArchive, std::initializer_list<Values>{name}, n, tokens, parms);
    context->archive_callback = outer;
}

RtArchiveHandle RiArchiveBeginV(RtToken name, RtInt n, RtToken tokens[], RtPointer parms[]) {
    Context* context = Context::current();
    if (!context) {
        tell_not_started();
        return nullptr;
    }
    context->send(Request::ArchiveBegin, std::initializer_list<Values>{name}, n, tokens, parms);
    return context->new_handle();
}

RtVoid RiArchiveRecord(RtToken type, char* format, ...) {
    va_list list, again;
    va_start(list, format);
    va_copy(again, list);
    int length = std::vsnprintf(nullptr, 0, format, list);
    std::string text(size_t(std::max(length, 0)) + 1, 0);
    std::vsnprintf(text.data(), text.size(), format, again);
    va_end(again);
    va_end(list);
    send(Request::ArchiveRecord, {type, text.c_str()});
}

RtToken RiDeclare(char* name, char* declaration) {
    Context* context = Context::current();
    if (!context) {
        tell_not_started();
        return nullptr;
    }
    auto declared = parse_declaration(declaration ? declaration : "");
    if (!name || !*name || !declared) {
        context->error(Code::RI_DECLARATION, declaration ? declaration : "", name ? name : "");
        return nullptr;
    }
    context->declarations().declare(name, *declared);
    send(Request::Declare, {name, declaration});
    return name;
}
