// runtime/scene/ri/state/shader_search.h: shaders by the names that requests give.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "rsl/compile.h"
#include "runtime/base/diagnostic.h"

namespace kinora::ri {

class ShaderSearch {
  public:
    // `options`: of the compiler. `folder`: of the first file, "" or ending in '/'.
    ShaderSearch(rsl::CompileOptions options, std::string folder, Diagnostics& diagnostics)
        : options_(std::move(options)), folder_(std::move(folder)), diagnostics_(diagnostics) {}

    // NAME.sl in the folders in turn, then in the first file's, then our own of that name. A path
    // before the name, and the suffix of a compiled shader (.slo .slx .sdl), are tried without.
    // Letters may differ in case. Of a file with several shaders that of the name is taken, else
    // the first. Null: there is none, or it does not compile, which is a finding then.
    std::shared_ptr<const rsl::Shader> find(std::string_view name,
                                            const std::vector<std::string>& folders);
    // The file that find() reads; "": there is none, and a shader of that name is ours.
    std::string file_of(std::string_view name, const std::vector<std::string>& folders) const;
    // The text that one of these was compiled from.
    rsl::ShaderSource source_of(const rsl::Shader& shader) const;
    const rsl::CompileOptions& options() const { return options_; }

  private:
    using Made = std::shared_ptr<const rsl::Shader>;
    Made compiled(const std::string& path, std::string_view name);

    rsl::CompileOptions options_;
    std::string folder_;
    Diagnostics& diagnostics_;
    struct File {
        FileId id = kNoFile;
        std::vector<Made> shaders;
    };
    std::map<std::string, File> by_path_;
    std::map<std::string, Made, std::less<>> by_name_;  // and folders
};

}  // namespace kinora::ri
