// collada/document/id_path.h: where in a document's tree a byte stands, in words.
#pragma once

#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "collada/document/document.h"

namespace kinora::collada {

// The elements of a document by their bytes. The document must outlive it.
class ElementIndex {
  public:
    explicit ElementIndex(const Document& document);

    const std::vector<const Element*>& all() const { return elements_; }  // in document order

    // The innermost element that holds the byte; the root for one outside of it.
    const Element& at(uint32_t offset) const;

    // The way from the root down, without it: "library_effects/effect[@id='Matte']/profile_RSL".
    // A step names its id, else its sid, else its number among siblings of that name where there
    // are several (as XPath does); the root alone is "COLLADA".
    std::string path(const Element& element);

  private:
    std::string step(const Element& element);
    std::string new_step(const Element& element);
    void number_children(const Element& parent);

    std::vector<const Element*> elements_;  // in document order
    std::unordered_set<const Element*> numbered_;
    std::unordered_map<const Element*, std::string> steps_;  // of those with many attributes
    std::unordered_map<const Element*, uint32_t> numbers_;   // of those with namesakes
};

// Fills the id path of every finding of the documents' own files, and of documents among
// `files` that others refer to.
void add_id_paths(const Document& document, const SourceFiles& files,
                  std::vector<Finding>& findings);

}  // namespace kinora::collada
