// tests/collada/reading.h: reads a document and keeps all that came of it.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "collada/extract/extract.h"
#include "collada/scene/scene.h"
#include "tests/folders.h"

namespace kinora::collada {

struct Reading {
    Diagnostics diag;
    std::optional<Document> document;
    std::optional<SceneData> scene;

    size_t count(std::string_view code) const {
        return size_t(std::count_if(diag.findings().begin(), diag.findings().end(),
                                    [&](const Finding& f) { return f.info->code == code; }));
    }
    // "line:column" of the first finding with this code, or "".
    std::string place(std::string_view code) const {
        for (const Finding& f : diag.findings()) {
            if (f.info->code != code) continue;
            LineColumn at = diag.files.line_column(f.where.file, f.where.begin);
            return std::to_string(at.line) + ":" + std::to_string(at.column);
        }
        return {};
    }
    // The bytes the first finding with this code points at.
    std::string pointed(std::string_view code) const {
        for (const Finding& f : diag.findings())
            if (f.info->code == code)
                return std::string(diag.files.text(f.where.file)
                                       .substr(f.where.begin, f.where.end - f.where.begin));
        return {};
    }
    std::string all() const {
        std::string text;
        for (const Finding& f : diag.findings()) text += format_finding(f, diag.files);
        return text;
    }
    const Node& node(std::string_view id) const {
        for (const Node& n : scene->nodes)
            if (n.id == id) return n;
        static const Node kNo;
        return kNo;
    }
};

inline void read_text(Reading& r, std::string text, const std::string& path = "test.dae") {
    r.document = read_document_text(path, std::move(text), r.diag);
    if (r.document) r.scene = extract(*r.document, r.diag);
}

inline std::string test_file(const std::string& name) {
    return project_folder() + "/tests/collada/files/" + name;
}

inline void read_file(Reading& r, const std::string& path, const ExtractOptions& options = {}) {
    r.document = read_document(path, r.diag);
    if (r.document) r.scene = extract(*r.document, r.diag, options);
}

// A document around some libraries and the content of one node.
inline std::string with_scene(const std::string& libraries, const std::string& nodes) {
    std::string asset =
        "<asset><created>2026-01-01T00:00:00Z</created><modified>2026-01-01T00:00:00Z</modified>"
        "</asset>";
    if (libraries.find("<asset>") != std::string::npos) asset.clear();
    return "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">" +
           asset + "\n" + libraries + "\n<library_visual_scenes><visual_scene id=\"vs\">" + nodes +
           "</visual_scene></library_visual_scenes><scene><instance_visual_scene url=\"#vs\"/>"
           "</scene></COLLADA>\n";
}

// A <source> of floats.
inline std::string float_source(const std::string& id, const std::string& values, int count,
                                const std::string& params) {
    std::string out = "<source id=\"" + id + "\"><float_array id=\"" + id + "-a\" count=\"" +
                      std::to_string(count * int(params.size())) + "\">" + values +
                      "</float_array><technique_common><accessor source=\"#" + id +
                      "-a\" count=\"" + std::to_string(count) + "\" stride=\"" +
                      std::to_string(params.size()) + "\">";
    for (char p : params) out += std::string("<param name=\"") + p + "\" type=\"float\"/>";
    return out + "</accessor></technique_common></source>";
}

// A geometry of one triangle, once for each of the materials named.
inline std::string triangle_geometry(const std::string& id,
                                     const std::vector<std::string>& materials) {
    std::string out = "<geometry id=\"" + id + "\"><mesh>" +
                      float_source(id + "-pos", "0 0 0 1 0 0 0 1 0", 3, "XYZ") + "<vertices id=\"" +
                      id + "-v\"><input semantic=\"POSITION\" source=\"#" + id +
                      "-pos\"/></vertices>";
    for (const std::string& material : materials)
        out += "<triangles count=\"1\" material=\"" + material +
               "\"><input semantic=\"VERTEX\" source=\"#" + id +
               "-v\" offset=\"0\"/><p>0 1 2</p></triangles>";
    return out + "</mesh></geometry>";
}

// A mesh over some positions, with the primitives given.
inline std::string with_mesh(const std::string& positions, int count, const std::string& primitives,
                             const std::string& sources = {}) {
    return with_scene("<library_geometries><geometry id=\"g\"><mesh>" +
                          float_source("pos", positions, count, "XYZ") + sources +
                          "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#pos\"/>"
                          "</vertices>" +
                          primitives + "</mesh></geometry></library_geometries>",
                      "<node id=\"n\"><instance_geometry url=\"#g\"/></node>");
}

}  // namespace kinora::collada
