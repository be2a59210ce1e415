// runtime/scene/gltf/export/influences.cpp: the joints of vertices as glTF has them.
#include "runtime/scene/gltf/export/influences.h"

#include <algorithm>

namespace kinora {

namespace {

// A joint may stand twice; glTF wants each once a vertex.
void join_repeated(std::vector<JointInfluence>& list) {
    for (size_t i = 0; i < list.size(); ++i)
        for (size_t k = i + 1; k < list.size();)
            if (list[k].joint == list[i].joint) {
                list[i].weight += list[k].weight;
                list.erase(list.begin() + long(k));
            } else {
                ++k;
            }
}

}  // namespace

std::vector<std::vector<JointInfluence>> vertex_influences(const SkinDefinition& skin,
                                                           const std::vector<uint32_t>& positions) {
    uint32_t still = uint32_t(skin.inverse_bind.size());  // the joint of the bind shape
    std::vector<std::vector<JointInfluence>> all;
    for (uint32_t p : positions) {
        std::vector<JointInfluence>& list = all.emplace_back();
        if (p + 1 < skin.offsets.size())
            for (uint32_t i = skin.offsets[p]; i < skin.offsets[p + 1]; ++i)
                if (skin.weights[i] > 0)
                    list.push_back(
                        {skin.joints[i] < 0 ? still : uint32_t(skin.joints[i]), skin.weights[i]});
        std::stable_sort(list.begin(), list.end(),
                         [](auto& a, auto& b) { return a.weight > b.weight; });
        if (list.empty()) list.push_back({0, 1.0f});  // what has no weight follows the root joint
        join_repeated(list);
        double sum = 0;
        for (const JointInfluence& i : list) sum += double(i.weight);
        for (JointInfluence& i : list) i.weight = float(double(i.weight) / sum);
    }
    return all;
}

}  // namespace kinora
