// collada/schema/content_model.cpp: content cells to automata.
#include "collada/schema/content_model_p.h"

#include <algorithm>

#include "collada/schema/schema_rows_p.h"
#include "runtime/base/check.h"

namespace kinora::collada {

namespace {

// content = item { item } | item { "|" item };  item = (word | "(" content ")") [ ? * + {m,n} ]
class ContentParser {
  public:
    explicit ContentParser(std::string_view text) : text_(text) {}

    Particle parse() {
        Particle all = sequence();
        CHECK(at_ == text_.size());  // a row with a stray ")" or "|"
        return all;
    }

  private:
    char peek() {
        while (at_ < text_.size() && text_[at_] == ' ') ++at_;
        return at_ < text_.size() ? text_[at_] : '\0';
    }

    Particle sequence() {
        Particle out;
        while (peek() && peek() != ')') {
            out.parts.push_back(item());
            if (peek() != '|') continue;
            out.kind = Particle::Kind::Choice;
            ++at_;
        }
        return out;
    }

    Particle item() {
        Particle out;
        if (peek() == '(') {
            ++at_;
            out = sequence();
            CHECK(peek() == ')');  // a row with an open "("
            ++at_;
        } else {
            out = word();
        }
        occurs(out);
        return out;
    }

    Particle word() {
        size_t end = std::min(text_.find_first_of(" ()|?*+{", at_), text_.size());
        std::string_view w = text_.substr(at_, end - at_);
        CHECK(!w.empty());
        at_ = end;
        Particle out;
        out.kind = w == "%any"        ? Particle::Kind::Any
                   : w == "%math"     ? Particle::Kind::Math
                   : w.front() == '@' ? Particle::Kind::Group
                                      : Particle::Kind::Element;
        if (out.kind == Particle::Kind::Group) w.remove_prefix(1);
        size_t mark = w.find_first_of(":=");
        out.name = w.substr(0, mark);
        out.type = mark == w.npos ? w : w.substr(w[mark] == '=' ? mark : mark + 1);
        return out;
    }

    uint32_t number() {
        uint32_t n = 0;
        while (at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9')
            n = n * 10 + uint32_t(text_[at_++] - '0');
        return n;
    }

    void occurs(Particle& out) {
        char c = at_ < text_.size() ? text_[at_] : '\0';
        if (c == '?' || c == '*') out.low = 0;
        if (c == '*' || c == '+') out.high = Particle::kMany;
        if (c == '?' || c == '*' || c == '+') ++at_;
        if (c != '{') return;
        ++at_;
        out.low = number();
        CHECK(text_[at_] == ',');
        ++at_;
        out.high = text_[at_] == '}' ? Particle::kMany : number();
        ++at_;
    }

    std::string_view text_;
    size_t at_ = 0;
};

struct Ends {
    bool nullable = false;
    std::vector<uint16_t> first, last;
};

void add(std::vector<uint16_t>& list, const std::vector<uint16_t>& more) {
    for (uint16_t p : more)
        if (std::find(list.begin(), list.end(), p) == list.end()) list.push_back(p);
}

class ModelBuilder {
  public:
    ModelBuilder(ContentModel& model, Version version) : model_(model), version_(version) {}

    Ends build(const Particle& particle) {
        // Copies for the least number; then one that repeats, or optional ones up to the most.
        bool many = particle.high == Particle::kMany;
        uint32_t copies = std::max(many ? particle.low : particle.high, 1u);
        bool outer = one_rank_;
        if (copies > 1 || many) share_rank();
        Ends all, before;
        for (uint32_t i = 0; i < copies; ++i) {
            Ends one = once(particle);
            if (many && i + 1 == copies) connect(one.last, one.first);
            if (i == 0) {
                all = one;
            } else if (one.nullable) {
                all = follow(all, one);
            } else {  // only from the copy before: a (a (a)?)?, so that one position suffices
                connect(before.last, one.first);
                if (i < particle.low) all.last.clear();
                add(all.last, one.last);
            }
            before = one;
        }
        all.nullable = all.nullable || particle.low == 0;
        one_rank_ = outer;
        return all;
    }

  private:
    // What repeats as a whole has no order of its own: (a | b)*.
    void share_rank() {
        if (!one_rank_) ++rank_;
        one_rank_ = true;
    }

    Ends once(const Particle& particle) {
        switch (particle.kind) {
            case Particle::Kind::Sequence: {
                Ends all{true, {}, {}};
                for (const Particle& part : particle.parts) all = follow(all, build(part));
                return all;
            }
            case Particle::Kind::Choice: {
                Ends all;
                for (const Particle& part : particle.parts) {
                    Ends one = build(part);
                    all.nullable = all.nullable || one.nullable;
                    add(all.first, one.first);
                    add(all.last, one.last);
                }
                return all;
            }
            case Particle::Kind::Group:
                return build(parse_content(group(particle.name)));
            case Particle::Kind::Element:
            case Particle::Kind::Any:
            case Particle::Kind::Math:
                return add_position(particle);
        }
        return {};
    }

    Ends add_position(const Particle& particle) {
        uint16_t at = uint16_t(model_.positions.size());
        ContentModel::Position& p = model_.positions.emplace_back();
        p.kind = particle.kind;
        if (p.kind == Particle::Kind::Element) p.name = particle.name, p.type_name = particle.type;
        if (!one_rank_) ++rank_;
        p.rank = rank_;
        return {false, {at}, {at}};
    }

    std::string_view group(std::string_view name) const {
        for (const ContentRow& row : group_rows())
            if (row.name == name && holds_for(row.versions, version_)) return row.content;
        CHECK(false);  // a row that names a group without one
        return {};
    }

    void connect(const std::vector<uint16_t>& from, const std::vector<uint16_t>& to) {
        for (uint16_t p : from) add(model_.positions[p].next, to);
    }

    Ends follow(const Ends& a, const Ends& b) {
        connect(a.last, b.first);
        Ends out{a.nullable && b.nullable, a.first, b.last};
        if (a.nullable) add(out.first, b.first);
        if (b.nullable) add(out.last, a.last);
        return out;
    }

    ContentModel& model_;
    Version version_;
    uint16_t rank_ = 0;
    bool one_rank_ = false;
};

}  // namespace

Particle parse_content(std::string_view cell) {
    return ContentParser(cell).parse();
}

ContentModel build_model(std::string_view cell, Version version) {
    ContentModel model;
    model.positions.emplace_back();
    Ends ends = ModelBuilder(model, version).build(parse_content(cell));
    model.positions[0].next = ends.first;
    model.positions[0].last = ends.nullable;
    for (uint16_t p : ends.last) model.positions[p].last = true;
    return model;
}

uint16_t ContentModel::find(std::string_view name) const {
    for (size_t i = 1; i < positions.size(); ++i)
        if (positions[i].name == name) return uint16_t(i);
    return 0;
}

std::vector<uint16_t> ContentModel::missing(uint16_t at, std::string_view name) const {
    std::vector<uint16_t> found;
    size_t least = ~size_t(0);
    for (uint16_t next : positions[at].next) {
        if (!name.empty() && positions[next].name == name) continue;
        bool there = name.empty() && positions[next].last;
        size_t steps = there ? 1 : way(next, name).size() + 1;
        if (!there && steps == 1) continue;  // no way from here
        if (steps < least) found.clear(), least = steps;
        if (steps == least) found.push_back(next);
    }
    return found;
}

std::vector<uint16_t> ContentModel::way(uint16_t at, std::string_view name) const {
    std::vector<uint16_t> from(positions.size(), 0), queue{at};
    std::vector<bool> seen(positions.size());
    for (size_t i = 0; i < queue.size(); ++i) {
        for (uint16_t next : positions[queue[i]].next) {
            if (seen[next]) continue;
            seen[next] = true;
            from[next] = queue[i];
            if (name.empty() ? !positions[next].last : positions[next].name != name) {
                queue.push_back(next);
                continue;
            }
            std::vector<uint16_t> found{next};
            while (from[found.back()] != at) found.push_back(from[found.back()]);
            std::reverse(found.begin(), found.end());
            return found;
        }
    }
    return {};
}

}  // namespace kinora::collada
