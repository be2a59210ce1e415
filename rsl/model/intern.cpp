// rsl/model/intern.cpp: the process-wide table of strings that shaders handle.
#include <deque>
#include <mutex>
#include <unordered_map>

#include "rsl/model/renderer_services.h"
#include "rsl/model/string_functions.h"
#include "runtime/base/check.h"

namespace kinora::rsl {

namespace {

struct Table {
    std::mutex mutex;
    std::deque<std::string> texts = {""};  // stable addresses
    std::unordered_map<std::string_view, int32_t> ids = {{"", 0}};
    size_t bytes = 0;
};

Table& table() {
    static Table& instance = *new Table;  // outlives every kernel
    return instance;
}

}  // namespace

int32_t intern(std::string_view text) {
    Table& t = table();
    std::lock_guard lock(t.mutex);
    if (auto found = t.ids.find(text); found != t.ids.end()) return found->second;
    const std::string& kept = t.texts.emplace_back(text);
    int32_t id = int32_t(t.texts.size()) - 1;
    t.ids.emplace(kept, id);
    t.bytes += text.size();
    return id;
}

size_t interned_bytes() {
    Table& t = table();
    std::lock_guard lock(t.mutex);
    return t.bytes;
}

int32_t interned_count() {
    Table& t = table();
    std::lock_guard lock(t.mutex);
    return int32_t(t.texts.size());
}

const std::string& interned(int32_t id) {
    Table& t = table();
    std::lock_guard lock(t.mutex);
    CHECK(id >= 0 && size_t(id) < t.texts.size());
    return t.texts[size_t(id)];
}

}  // namespace kinora::rsl
