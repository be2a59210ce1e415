// runtime/programs/convert/convert.h: kinora-convert: one scene file to another format.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/base/diagnostic.h"
#include "runtime/programs/common/finding_printer.h"
#include "runtime/scene/description/scene_description.h"

namespace kinora {

// A file that is written beside the document: its name relative to it.
struct WrittenFile {
    std::string name, bytes;
};
using WrittenFiles = std::vector<WrittenFile>;

struct ConvertOptions {
    std::string input, output;
    std::vector<std::pair<std::string, std::string>>
        shaders;  // MATERIAL or LIGHT, FILE.sl or a name
    std::vector<std::string> include_directories;
    std::optional<UpAxis> up_axis;            // of the output; the picture stays
    std::optional<double> meter;              // likewise
    bool copy_textures = false;               // into textures/ beside a .dae
    double animation_error = 1e-4;            // GltfExportOptions
    std::vector<std::string> allow_external;  // folders outside the scene's that it may read
    bool confine = false;                     // pictures too
    bool ignore_required = false;             // ImportOptions
    int threads = 0;                          // 0: all
    FindingOptions findings;
    bool stats = false, stats_json = false;
    // -r: input and output are folders.
    bool recursive = false;
    std::string to;      // the extension of the outputs: glb, gltf or dae
    int jobs = 1;        // files at once
    std::string report;  // a file; "" for none
};

// Reads the command line. Returns an exit code when there is nothing to do.
std::optional<int> parse_convert_options(int argc, char** argv, ConvertOptions& options);

// Converts and returns the exit code; findings go to `diagnostics` and to stderr.
int convert(const ConvertOptions& options, Diagnostics& diagnostics);

// -r: converts all scene files below the input folder. A file that fails costs that file alone.
int convert_folder(const ConvertOptions& options);

// .dae to .dae: the document with the options worked into it, in canonical form. Nothing on an
// error, which was reported.
std::optional<std::string> convert_document(const ConvertOptions& options, Diagnostics& diag);

// --- the steps of convert_document, each on the document's text ----------------------------------

// The text with the shaders of the options, one after another, in profile_RSL of the effects of the
// materials and lights that they match. An effect that others share is copied. Stages that a shader
// does not give stay. CONVERT_STAGE_TWICE where one takes the place of an earlier one.
std::optional<std::string> embed_shaders(const std::string& path, std::string text,
                                         const ConvertOptions& options, Diagnostics& diag);

// The text of a document whose axes and unit are others and whose picture is the same: one node
// with the change of axes around those of each visual scene; lengths of cameras and lights anew.
std::string change_axes(const std::string& path, const std::string& text,
                        std::optional<UpAxis> up_axis, std::optional<double> meter,
                        Diagnostics& diag);

// The text with relative links of files (images, other documents, shaders) as seen from another
// folder. `archive` is the folder that a .zae was unpacked to ("" for none): its files are copied
// into NAME_files beside NAME.dae, where the links then lead. CONVERT_OUTSIDE for links that lead
// out of the new document's folder. Pictures that the old document's readers find elsewhere are
// linked where they are; FILE_MISSING for those that are nowhere.
std::string move_links(const std::string& path, const std::string& text,
                       const std::string& new_path, const std::string& archive, Diagnostics& diag);

// --copy-textures: the text with pictures linked in textures/ beside the output. `files` are those
// to write beside it: they move there, and the pictures come to them.
std::string copy_textures(const std::string& output, const std::string& text, WrittenFiles& files);

}  // namespace kinora
