// runtime/base/shared_library.h: libraries that are opened when something first needs them. A start
// of a program then does not pay for what the run does not use.
#pragma once

#include <string>
#include <string_view>

namespace kinora {

// One library; it stays open until the program ends. Make one in a function's static.
class SharedLibrary {
  public:
    // `file`: a soname ("libzip.so.4") or a path. `purpose` and `package` complete the error:
    // "archives are read by libzip.so.4, which cannot be loaded (...); install libzip4".
    SharedLibrary(const std::string& file, std::string_view purpose, std::string_view package);

    // Sets `symbol` to what the library has under that name, or to null with an error.
    template <class T>
    void bind(T*& symbol, const char* name) {
        symbol = reinterpret_cast<T*>(find(name));
    }

    // Why it cannot be used: it cannot be opened, or lacks a name that bind() was given. Else "".
    const std::string& error() const { return error_; }

  private:
    void* find(const char* name);
    void fail(const std::string& why);

    std::string file_, purpose_, package_;
    void* handle_;
    std::string error_;
};

// Where a module of ours lies: BIN/../lib/FILE, in the build and where the programs are installed.
std::string module_path(std::string_view file);

}  // namespace kinora

// Tables of a library's functions: a list macro LIST(X) that says X(name) for each, and in a struct
//     LIST(KINORA_LIBRARY_MEMBER)  // a pointer called as the function is
// and where `library` is the SharedLibrary
//     LIST(KINORA_LIBRARY_BIND)
#define KINORA_LIBRARY_MEMBER(name) decltype(&::name) name = nullptr;
#define KINORA_LIBRARY_BIND(name) library.bind(this->name, #name);
