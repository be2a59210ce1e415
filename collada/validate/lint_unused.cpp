// collada/validate/lint_unused.cpp: library items that nothing leads to from <scene>.
#include <algorithm>
#include <unordered_set>

#include "collada/text/encoding_p.h"
#include "collada/text/numbers_p.h"
#include "collada/validate/lint_p.h"

namespace kinora::collada {

namespace {

// Attributes whose value is never a link.
constexpr std::string_view kNames[] = {"id",     "sid",       "name",    "semantic", "symbol",
                                       "count",  "stride",    "offset",  "set",      "type",
                                       "digits", "magnitude", "version", "profile",  "opaque"};

// Whatever could be read as the id of an item makes it used: a wrong finding would cost more than
// a missing one.
class Reachable {
  public:
    explicit Reachable(Lint& lint) : lint_(lint) {
        for (const Element& library : lint.document.root().children())
            if (library.name.starts_with("library_"))
                for (const Element& item : library.children())
                    if (item.name != "asset" && item.name != "extra") item_of_[&item] = false;
    }
    void follow(const Element& root) {
        visit(root);
        while (!pending_.empty()) {
            const Element* item = pending_.back();
            pending_.pop_back();
            visit(*item);
        }
    }
    bool used(const Element& item) const { return item_of_.at(&item); }
    void take(const Element& item) {
        item_of_[&item] = true;
        follow(item);
    }

  private:
    // As deep as the document may be.
    void visit(const Element& element) {
        for (const Attribute& a : element.attributes) {
            size_t hash = a.value.find('#');
            if (hash != a.value.npos)
                name(a.value.substr(hash + 1));
            else if (std::find(std::begin(kNames), std::end(kNames), a.name) == std::end(kNames))
                name(a.value);
        }
        if (!element.first_child) visit_text(element);
        for (const Element& child : element.children()) visit(child);
    }
    // Shader sources may name images and coordinate systems in their strings.
    void visit_code(std::string_view code) {
        size_t open = code.find('"');
        while (open != code.npos) {
            size_t close = code.find('"', open + 1);
            if (close == code.npos) return;
            mark(code.substr(open + 1, close - open - 1));
            open = code.find('"', close + 1);
        }
    }
    void visit_text(const Element& element) {
        if (element.name == "code") return visit_code(element.text);
        constexpr size_t kLongestLink = 1024;
        bool ids = element.name.ends_with("_array") && element.name != "float_array";
        if (element.text.size() > kLongestLink && !ids) return;
        // Most texts are numbers, which no id begins like.
        auto may_name = [](char c) { return c > '9' || c == '#' || c < 0; };
        if (std::none_of(element.text.begin(), element.text.end(), may_name)) return;
        for (std::string_view word : split_words(element.text)) {
            if (word[0] <= '9' && word[0] != '#') continue;  // a number
            name(word.substr(word.find('#') == word.npos ? 0 : word.find('#') + 1));
        }
    }
    void name(std::string_view id) {
        mark(id);
        size_t slash = id.find('/');
        if (slash != id.npos) mark(id.substr(0, slash));  // a path of sids
        if (id.find('%') != id.npos) mark(percent_decode(id));
    }
    void mark(std::string_view id) {
        const Element* first = lint_.document.find(id);
        if (!first || !seen_.insert(first).second) return;
        for (const Element* e = first; e; e = e->next_same_id) {
            const Element* item = e;
            while (item && !item_of_.count(item)) item = item->parent;
            if (!item) continue;
            bool& used = item_of_[item];
            if (!used) pending_.push_back(item);
            used = true;
        }
    }

    Lint& lint_;
    std::unordered_map<const Element*, bool> item_of_;  // whether it is used
    std::unordered_set<const Element*> seen_;           // the first of each id that was named
    std::vector<const Element*> pending_;
};

std::string label(const Element& item) {
    for (std::string_view attribute : {"id", "name"})
        if (!item.value(attribute).empty()) return fmt::format("'{}'", item.value(attribute));
    return "without an id";
}

}  // namespace

namespace {

// Where <scene> leads to no visual scene, the first one is shown.
void follow_shown_scene(Lint& lint, Reachable& reachable) {
    const Element* first = nullptr;
    for (const Element& library : lint.document.root().children())
        for (const Element& item : library.children())
            if (library.name == "library_visual_scenes" && item.name == "visual_scene") {
                if (reachable.used(item)) return;
                if (!first) first = &item;
            }
    if (first) reachable.take(*first);
}

}  // namespace

void lint_unused(Lint& lint) {
    const Element* scene = lint.document.root().child("scene");
    if (!scene || !scene->first_child) return;  // a library for other documents
    Reachable reachable(lint);
    reachable.follow(*scene);
    if (scene->child("instance_visual_scene")) follow_shown_scene(lint, reachable);
    for (const Element& extra : lint.document.root().children())
        if (extra.name == "extra") reachable.follow(extra);
    for (const Element& library : lint.document.root().children()) {
        // Animations and clips play by themselves.
        if (!library.name.starts_with("library_") || library.name.starts_with("library_animation"))
            continue;
        for (const Element& item : library.children()) {
            if (item.name == "asset" || item.name == "extra" || reachable.used(item)) continue;
            lint.diag.report(Code::INFO_UNUSED, lint.where(item), item.name, label(item));
        }
    }
}

}  // namespace kinora::collada
