// rsl/text/includes.h: which file an #include means, and its text.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rsl/text/compile_options.h"
#include "rsl/text/file_stack.h"
#include "rsl/text/reporter.h"
#include "rsl/text/text_store.h"

namespace kinora::rsl {

inline constexpr uintmax_t kMostIncludeBytes = 64 << 20;  // of one file

class Includes {
  public:
    Includes(const CompileOptions& options, SourceFiles& files, TextStore& texts,
             Reporter& reporter)
        : options_(options), files_(files), texts_(texts), reporter_(reporter) {}

    // The text of "file" (quoted) or <file>, included by the file `from`. Nothing where there is
    // none, which is reported at `at`, or where it says "#pragma once" and has been read.
    std::optional<SourceText> find(std::string file, bool quoted, const std::string& from,
                                   const Token& at);
    // The file has "#pragma once".
    void read_once(const std::string& path);

  private:
    const CompileOptions& options_;
    SourceFiles& files_;
    TextStore& texts_;
    Reporter& reporter_;
    std::vector<std::string> once_;  // paths of files with #pragma once
};

}  // namespace kinora::rsl
