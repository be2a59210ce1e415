// runtime/base/shared_library.cpp: dlopen, dlsym and what their failures mean to a user.
#include "runtime/base/shared_library.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>

#include <filesystem>
#include <new>

namespace kinora {

namespace {

// dlerror() has no number. The texts are glibc's, untranslated in the C locale that programs run
// in.
bool is_out_of_memory(std::string_view why) {
    return why.find("failed to map segment") != why.npos ||
           why.find("annot allocate memory") != why.npos ||
           why.find("annot map zero-fill pages") != why.npos ||
           why.find("annot create") != why.npos;
}

}  // namespace

SharedLibrary::SharedLibrary(const std::string& file, std::string_view purpose,
                             std::string_view package)
    : file_(file),
      purpose_(purpose),
      package_(package),
      handle_(dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)) {
    if (handle_) return;
    const char* why = dlerror();
    if (why && is_out_of_memory(why)) throw std::bad_alloc();
    fail(why ? why : "unknown reason");
}

SharedLibrary::Symbol SharedLibrary::find(const char* name) {
    if (!error_.empty()) return {nullptr};
    void* found = dlsym(handle_, name);
    if (!found) fail(fmt::format("it lacks {}", name));
    return {found};
}

void SharedLibrary::fail(const std::string& why) {
    error_ = fmt::format("{} by {}, which cannot be loaded ({}); install {}", purpose_,
                         std::filesystem::path(file_).filename().string(), why, package_);
}

namespace {

// Of the library that this code is linked into; of a program, BIN/../lib.
std::filesystem::path module_folder() {
    Dl_info info{};
    void* found = nullptr;
    if (dladdr1(reinterpret_cast<const void*>(&module_path), &info, &found, RTLD_DL_LINKMAP) != 0) {
        const auto* own = static_cast<const link_map*>(found);  // a program has no name in it
        if (own && own->l_name && *own->l_name)
            return std::filesystem::absolute(own->l_name).parent_path();
    }
    std::error_code code;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", code);
    return program.parent_path().parent_path() / "lib";
}

}  // namespace

std::string module_path(std::string_view file) {
    static const std::filesystem::path folder = module_folder();  // before anyone changes directory
    return (folder / file).string();
}

}  // namespace kinora
