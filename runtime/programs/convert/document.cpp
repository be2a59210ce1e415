// runtime/programs/convert/document.cpp: .dae to canonical .dae: through the Document, nothing
// lost.
#include "collada/document/edit.h"
#include "collada/document/open_scene.h"
#include "collada/document/write.h"
#include "runtime/programs/convert/convert.h"

namespace kinora {

using collada::Document;

std::optional<std::string> convert_document(const ConvertOptions& options, Diagnostics& diag) {
    std::optional<collada::SceneFile> file = collada::open_scene(options.input, diag);
    if (!file) return std::nullopt;
    std::optional<Document> document = collada::read_document(file->document, diag);
    if (!document || !document->whole()) return std::nullopt;  // an Error says why
    std::string path = document->path();
    // The text is UTF-8 by now, whatever the file was.
    std::string text = move_links(path, collada::declared_utf8(diag.files.text(document->file())),
                                  options.output, file->folder, diag);
    std::optional<std::string> shaded = embed_shaders(path, std::move(text), options, diag);
    if (!shaded) return std::nullopt;
    text = std::move(*shaded);
    if (options.up_axis || options.meter)
        text = change_axes(path, text, options.up_axis, options.meter, diag);
    Diagnostics again;
    std::optional<Document> result = collada::read_document_text(options.output, text, again);
    if (!result || !result->whole()) {
        for (const Finding& f : again.findings()) diag.add(*f.info, {}, f.message);
        return std::nullopt;
    }
    // Never longer than it was: what has no indents gets none.
    for (collada::Layout layout : {collada::Layout::Indented, collada::Layout::Lines}) {
        std::string written = collada::write(*result, again.files, layout);
        if (written.size() <= text.size()) return written;
    }
    return collada::write(*result, again.files, collada::Layout::Dense);
}

}  // namespace kinora
