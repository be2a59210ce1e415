// rsl/model/intern.cpp: the process-wide table of strings that shaders handle.
#include "rsl/model/renderer_services.h"
#include "rsl/model/string_functions.h"
#include "rsl/model/text_table.h"

namespace kinora::rsl {

namespace {

TextTable& table() {
    static TextTable& instance = *new TextTable;  // outlives every kernel
    return instance;
}

}  // namespace

int32_t intern(std::string_view text) {
    return table().id(text);
}

size_t interned_bytes() {
    return table().bytes();
}

int32_t interned_count() {
    return table().count();
}

const std::string& interned(int32_t id) {
    return table().text(id);
}

}  // namespace kinora::rsl
