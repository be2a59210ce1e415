// collada/schema/content_model_p.h: which children an element may have, in which order.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "collada/document/document.h"

namespace kinora::collada {

struct ElementType;

// The parsed form of a content cell of elements.def.
struct Particle {
    enum class Kind : uint8_t { Element, Any, Math, Group, Sequence, Choice };
    static constexpr uint32_t kMany = ~0u;
    Kind kind = Kind::Sequence;
    uint32_t low = 1, high = 1;
    std::string_view name;        // of an element or group
    std::string_view type;        // "=simple", or the row's name
    std::vector<Particle> parts;  // of a sequence or choice
};

// CHECKs that the cell is written as elements.def says.
Particle parse_content(std::string_view cell);

// A content model as a position automaton (Glushkov): being at a position means that the child
// it stands for was the last one. COLLADA's models are deterministic, so that one position
// suffices.
struct ContentModel {
    struct Position {
        std::string_view name;  // of the child; "" for %any and for the start
        Particle::Kind kind = Particle::Kind::Element;
        std::string_view type_name;
        const ElementType* type = nullptr;
        uint16_t rank = 0;           // the same for positions that may alternate: their order
        bool last = false;           // the element may end here
        std::vector<uint16_t> next;  // positions that may follow
    };
    std::vector<Position> positions;  // [0] is the start

    bool empty() const { return positions.size() == 1; }
    // The position after `at` for a child of COLLADA's namespace, or 0.
    uint16_t step(uint16_t at, std::string_view name) const {
        for (uint16_t next : positions[at].next)
            if (positions[next].name == name) return next;
        return 0;
    }
    uint16_t step(uint16_t at, Particle::Kind kind) const {
        for (uint16_t next : positions[at].next)
            if (positions[next].kind == kind) return next;
        return 0;
    }
    uint16_t find(std::string_view name) const;  // the first position of this name, or 0
    // What comes first on the shortest ways from `at` to a position of this name, or ("") to the
    // end: what is missing there.
    std::vector<uint16_t> missing(uint16_t at, std::string_view name) const;
    // The shortest way from `at` to a position of this name, or ("") to one where the element may
    // end: the positions entered. Empty if there is none.
    std::vector<uint16_t> way(uint16_t at, std::string_view name) const;
};

ContentModel build_model(std::string_view cell, Version version);

}  // namespace kinora::collada
