// runtime/base/shared_library.h: libraries that are opened when something first needs them. A start
// of a program then does not pay for what the run does not use.
#pragma once

#include <string>
#include <string_view>

namespace kinora {

// One library; it stays open until the program ends. What is used of it are members of a struct:
//     struct Zip : SharedLibrary {
//         Zip() : SharedLibrary(KINORA_ZIP_LIBRARY, "archives are read", "libzip4") {}
//         KINORA_FUNCTION(zip_fopen);
//     };
//     opened<Zip>().zip_fopen(...)
class SharedLibrary {
  public:
    // `file`: a soname ("libzip.so.4") or a path. `purpose` and `package` complete the error:
    // "archives are read by libzip.so.4, which cannot be loaded (...); install libzip4".
    // Throws bad_alloc where there is no memory to map it.
    SharedLibrary(const std::string& file, std::string_view purpose, std::string_view package);
    SharedLibrary(const SharedLibrary&) = delete;

    // Why it cannot be used: it cannot be opened, or lacks a name. Else "".
    const std::string& error() const { return error_; }

  protected:
    // The address of a name, of whatever type the library's header gives it.
    struct Symbol {
        void* address;
        template <class T>
        operator T*() const {
            return reinterpret_cast<T*>(address);
        }
    };
    // Null, with an error, where the library has no such name.
    Symbol find(const char* name);

  private:
    void fail(const std::string& why);

    std::string file_, purpose_, package_;
    void* handle_;
    std::string error_;
};

// The library of this process, opened by the first call and never freed: objects that end after the
// program's main() may still use it.
template <class Library>
const Library& opened() {
    static const Library& library = *new Library;
    return library;
}

// Where a module of ours lies: beside the library that this code is part of; for a program, in
// BIN/../lib, in the build and where the programs are installed.
std::string module_path(std::string_view file);

}  // namespace kinora

// A function of a library as a member of a struct that is a SharedLibrary: called as itself.
#define KINORA_FUNCTION(name) decltype(&::name) name = find(#name)
