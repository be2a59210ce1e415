// raytrace/kept_trees.cpp: trees by what they were built of.
#include "raytrace/kept_trees.h"

#include <cstring>

#include "raytrace/kept_trees_p.h"
#include "runtime/base/files/content_hash.h"

namespace kinora::raytrace {
namespace {

uint64_t hash_of(const ShapeSource& source) {
    ContentHash hash;
    hash.add(source.positions.data(), source.positions.size_bytes());
    hash.add(source.triangles.data(), source.triangles.size_bytes());
    return hash.value();
}

template <class T>
bool same_bytes(std::span<const T> a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

}  // namespace

KeptTrees::KeptTrees() : state_(std::make_unique<State>()) {}
KeptTrees::~KeptTrees() = default;

void KeptTrees::State::begin() {
    std::lock_guard lock(mutex_);
    std::erase_if(entries_, [&](const auto& entry) { return entry.second.used + 1 < accel_; });
    ++accel_;
}

std::shared_ptr<ShapeTree> KeptTrees::State::find(const ShapeSource& source) {
    const uint64_t hash = hash_of(source);
    std::lock_guard lock(mutex_);
    auto [first, last] = entries_.equal_range(hash);
    for (auto at = first; at != last; ++at) {
        Entry& entry = at->second;
        if (entry.robust != source.robust || entry.filtered != source.filtered ||
            entry.tree->scale != source.scale ||
            !same_bytes(source.positions, entry.tree->positions) ||
            !same_bytes(source.triangles, entry.tree->triangles))
            continue;
        entry.used = accel_;
        return entry.tree;
    }
    return nullptr;
}

void KeptTrees::State::keep(const ShapeSource& source, std::shared_ptr<ShapeTree> tree) {
    const uint64_t hash = hash_of(source);
    std::lock_guard lock(mutex_);
    entries_.insert({hash, {std::move(tree), source.robust, source.filtered, accel_}});
}

}  // namespace kinora::raytrace
