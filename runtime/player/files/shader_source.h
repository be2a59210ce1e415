// runtime/player/files/shader_source.h: where a shader's text stands, and how it is put back there.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rsl/model/shader.h"
#include "runtime/base/diagnostic.h"

namespace kinora {

struct ShaderSourceText {
    std::string file;       // the .sl, or the document it is embedded in; "" one of ours
    std::string name;       // for findings of an edited text; its folder is the file's
    std::string text;       // decoded: as the compiler has it
    bool embedded = false;  // between <code> tags
    bool cdata = false;
    uint32_t begin = 0, end = 0;  // bytes of the file that the text stands for
    std::string why_fixed;        // it cannot be saved there; "" it can
};

// Of a checked shader, from the texts that it was compiled from.
ShaderSourceText source_of(const rsl::Shader& shader, const SourceFiles& files);

// The text around a place: an element <code>, or the whole file.
struct TextRange {
    FileId file = kNoFile;
    size_t begin = 0, end = 0;
    bool operator==(const TextRange&) const = default;
};
// Where a shader is defined; kNoFile where it is one of ours, or nobody knows.
TextRange text_range(const rsl::Shader& shader, const SourceFiles& files);

// A material whose effect's embedded text has an error, so that there is no shader.
struct BrokenShader {
    std::string material;  // its id
    ShaderSourceText source;
};
// Adds the materials of a document that wear the effect in which the error stands, each once.
void add_broken_shaders(const SourceFiles& files, Location error, std::vector<BrokenShader>& to);

// The text as XML has it: in one or several CDATA sections, or with its < and & written out.
std::string xml_text(const std::string& text, bool cdata);
// The other way round, of what stands between tags.
std::string plain_text(std::string_view xml, bool& cdata);

// Writes the text to where it stands; every other byte of the file stays. The file must be as it
// was read. An error text, or "".
std::string save_source(const ShaderSourceText& source, const std::string& text);

}  // namespace kinora
