// collada/extract/linked_documents_p.h: the root document and those that its links lead to.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "collada/document/document.h"
#include "collada/extract/extract.h"
#include "collada/extract/memory_budget_p.h"
#include "collada/scene/scene.h"
#include "runtime/base/allowed_paths.h"

namespace kinora::collada {

// Numbers documents in the order of SceneData::documents; fills that list.
class LinkedDocuments {
  public:
    LinkedDocuments(Diagnostics& diag, const ExtractOptions& options, MemoryBudget& budget,
                    SceneData& scene)
        : diag_(diag), options_(options), budget_(budget), scene_(scene) {}

    // Holds all documents to the rules of one version, not to those of their own.
    void hold_to(Version schema) { schema_ = schema; }
    // Adds a document already read, which outlives this; its <asset> is read.
    uint32_t add(const Document& document, const std::string& real_path);
    // The documents of another extraction, which outlives this.
    void see(const LinkedDocuments& other) { documents_ = other.documents_; }
    // The document that `file`, a URI without fragment in document `from`, means: read if it is
    // new. kNone and a finding if there is none.
    uint32_t linked(uint32_t from, std::string_view file, Location where);

    // The same of a path of the file system, which findings call `file`.
    uint32_t at_path(const std::string& path, std::string_view file, Location where);

    // The same if it was read already; kNone if not.
    uint32_t find(uint32_t from, std::string_view file);

    const Document& operator[](uint32_t doc) const { return *documents_[doc]; }
    uint32_t size() const { return uint32_t(documents_.size()); }
    // Where documents and shaders may lie: the folder of the root, and what is allowed.
    const AllowedPaths& allowed_paths();
    // Pictures may lie anywhere, unless the options confine them; those of an archive are in it.
    const AllowedPaths& allowed_pictures();

  private:
    std::string path_of_link(uint32_t from, std::string_view file, Location where);
    void report_unread(const std::string& path, std::string_view file, Location where);

    Diagnostics& diag_;
    const ExtractOptions& options_;
    MemoryBudget& budget_;
    SceneData& scene_;
    std::optional<Version> schema_;
    std::optional<AllowedPaths> allowed_, pictures_;
    std::vector<const Document*> documents_;
    std::vector<std::unique_ptr<Document>> owned_;
    std::unordered_map<std::string, uint32_t> by_path_;  // kNone: it cannot be read
    std::unordered_map<std::string, uint32_t> by_link_;  // by the path as linked
};

}  // namespace kinora::collada
