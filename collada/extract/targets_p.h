// collada/extract/targets_p.h: resolves the target strings of channels and binds.
#pragma once

#include "collada/extract/extract_p.h"

namespace kinora::collada {

class TargetResolver {
  public:
    explicit TargetResolver(Extraction& x) : x_(x) {}

    // What `target` names; Owner::None otherwise, with `unresolved` (or a finer finding) reported,
    // except when it names something the scene does not reach. `stride` is how many numbers the
    // channel brings a key (0: any).
    TargetRef resolve(uint32_t doc, std::string_view target, Location where, uint32_t stride,
                      const FindingInfo& unresolved);

  private:
    struct Found {
        const Element* element = nullptr;
        std::string_view selector;
        TargetRef ref;  // set when it is a material's parameter
    };
    Found find(const Element& root, uint32_t doc, const std::vector<std::string_view>& path);
    const Element* find_sid(const Element& scope, std::string_view sid);
    const Element* find_named(const Element& root, const Element& scope, std::string_view name);
    const Element* find_below(const Element& scope, uint32_t doc, std::string_view id) const;
    const Element* named_twice(uint32_t doc, std::string_view id, Location where) const;
    TargetRef material_param(const Element& material, std::string_view ref);
    const Slot* slot_of(const TargetRef& ref) const;
    bool is_reached(const Element* element) const;
    // These give what is wrong, or null.
    const char* apply_selector(std::string_view selector, uint32_t stride, TargetRef& ref) const;
    const char* apply_index(std::string_view selector, TargetRef& ref) const;
    const char* apply_member(std::string_view name, TargetRef& ref) const;
    void apply_whole(uint32_t stride, TargetRef& ref) const;

    Extraction& x_;
    using Names = std::unordered_map<std::string_view, const Element*>;
    std::unordered_map<const Element*, Names> sids_;   // below a scope
    std::unordered_map<const Element*, Names> named_;  // targets below a scope, by element name
};

}  // namespace kinora::collada
