// runtime/programs/convert/code_links_p.h: files that RSL code names, as seen from another folder.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "collada/document/document.h"

namespace kinora {

// What code names lies beside its document, wherever a header lies. Code that names files can
// therefore not stay in its file when the document moves: it is written out with its new names.
class CodeLinks {
  public:
    // How the moved document names a file: a picture (or another thing that shaders read) or code.
    using Moved = std::function<std::string(const std::filesystem::path& file, bool picture)>;

    // `folder` is the old document's, absolute.
    CodeLinks(std::filesystem::path folder, Moved moved)
        : folder_(std::move(folder)), moved_(std::move(moved)) {}

    // The code of a file with its headers and pictures as the moved document names them. Headers
    // that name pictures themselves stand in place of their #include lines. Nothing where neither
    // the file nor a header of it names one.
    std::optional<std::string> moved_code(const std::filesystem::path& file);

  private:
    std::filesystem::path folder_;
    Moved moved_;
    std::set<std::filesystem::path> open_;  // files that include this one
    int files_left_ = 1000;                 // headers that include each other twice over
};

// Whether the byte is inside a CDATA section of the element's text.
bool in_section(std::string_view document, const collada::Element& e, uint32_t byte);

// Code as it is written inside a CDATA section, or as escaped text.
std::string code_text(const std::string& code, bool in_section);

}  // namespace kinora
