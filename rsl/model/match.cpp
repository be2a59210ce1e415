// rsl/model/match.cpp: regular expressions as automata that are in all their states at once
// (Thompson, 1968), so that no pattern takes more time than its length times the text's.
#include <bitset>
#include <string_view>
#include <vector>

#include "rsl/model/string_functions.h"

namespace kinora::rsl {

namespace {

enum class Step : uint8_t { Set, Split, Begin, End, Found };

// A state: what it takes to go on to `next` (and, of a Split, to `other` as well).
struct State {
    Step step;
    int next = -1;
    int other = -1;
    std::bitset<256> set;
};

// A piece of the automaton: where it starts and the exits that are still open.
struct Piece {
    int start;
    std::vector<int*> exits;
};

// regex = branch { "|" branch }; branch = { atom [*+?] }
class Compiler {
  public:
    explicit Compiler(std::string_view pattern) : pattern_(pattern) {
        states.reserve(4 * pattern.size() + 8);  // exits point into it
        Piece all = alternatives();
        int found = add({Step::Found, -1, -1, {}});
        close(all, found);
        start = all.start;
    }

    std::vector<State> states;
    int start = 0;

  private:
    bool at_end() const { return at_ >= pattern_.size(); }
    int add(State state) {
        states.push_back(state);
        return int(states.size()) - 1;
    }
    static void close(Piece& piece, int to) {
        for (int* exit : piece.exits) *exit = to;
    }
    Piece single(State state) {
        int k = add(state);
        return {k, {&states[size_t(k)].next}};
    }
    // A state that goes on without a character.
    Piece nothing() {
        Piece piece = single({Step::Split, -1, -1, {}});
        return piece;
    }

    Piece alternatives() {
        Piece left = branch();
        while (!at_end() && pattern_[at_] == '|') {
            ++at_;
            Piece right = branch();
            int split = add({Step::Split, left.start, right.start, {}});
            right.exits.insert(right.exits.end(), left.exits.begin(), left.exits.end());
            left = {split, std::move(right.exits)};
        }
        return left;
    }

    Piece branch() {
        Piece all = nothing();
        while (!at_end() && pattern_[at_] != '|' && !(pattern_[at_] == ')' && depth_ > 0)) {
            Piece next = repeated(atom());
            close(all, next.start);
            all.exits = std::move(next.exits);
        }
        return all;
    }

    Piece repeated(Piece piece) {
        while (!at_end() &&
               (pattern_[at_] == '*' || pattern_[at_] == '+' || pattern_[at_] == '?')) {
            char c = pattern_[at_++];
            int split = add({Step::Split, piece.start, -1, {}});
            int* out = &states[size_t(split)].other;
            if (c == '?') {
                piece.exits.push_back(out);
                piece.start = split;
                continue;
            }
            close(piece, split);
            piece = {c == '*' ? split : piece.start, {out}};
        }
        return piece;
    }

    Piece atom() {
        char c = pattern_[at_++];
        State state{Step::Set, -1, -1, {}};
        switch (c) {
            case '(': {
                if (depth_ >= 100) break;  // then it is a character
                ++depth_;
                Piece inner = alternatives();
                --depth_;
                if (!at_end()) ++at_;  // the closing one
                return inner;
            }
            case '^':
                state.step = Step::Begin;
                return single(state);
            case '$':
                state.step = Step::End;
                return single(state);
            case '.':
                state.set.set();
                return single(state);
            case '[':
                return single(bracket());
            case '\\':
                if (!at_end()) c = pattern_[at_++];
                break;
        }
        state.set.set(uint8_t(c));
        return single(state);
    }

    State bracket() {
        State state{Step::Set, -1, -1, {}};
        bool negated = !at_end() && pattern_[at_] == '^';
        at_ += negated;
        for (bool first = true; !at_end() && (first || pattern_[at_] != ']'); first = false) {
            uint8_t from = uint8_t(pattern_[at_++]), to = from;
            bool range =
                at_ + 1 < pattern_.size() && pattern_[at_] == '-' && pattern_[at_ + 1] != ']';
            if (range) {
                to = uint8_t(pattern_[at_ + 1]);
                at_ += 2;
            }
            for (int k = from; k <= to; ++k) state.set.set(size_t(k));
        }
        at_ += !at_end();
        if (negated) state.set.flip();
        return state;
    }

    std::string_view pattern_;
    size_t at_ = 0;
    int depth_ = 0;
};

// The states reached without a character.
class Front {
  public:
    Front(const std::vector<State>& states, std::string_view text)
        : states_(states), text_(text), mark_(states.size(), -1) {}

    // True when the end of the expression is reached.
    bool add(int start, size_t at) {
        open_ = {start};
        while (!open_.empty()) {
            int k = open_.back();
            open_.pop_back();
            if (k < 0 || mark_[size_t(k)] == int(at)) continue;
            mark_[size_t(k)] = int(at);
            const State& state = states_[size_t(k)];
            if (state.step == Step::Found) return true;
            if (state.step == Step::Set) waiting.push_back(k);
            bool passes = state.step == Step::Split || (state.step == Step::Begin && at == 0) ||
                          (state.step == Step::End && at == text_.size());
            if (!passes) continue;
            open_.push_back(state.next);
            if (state.step == Step::Split) open_.push_back(state.other);
        }
        return false;
    }
    std::vector<int> waiting;  // for a character

  private:
    const std::vector<State>& states_;
    std::string_view text_;
    std::vector<int> mark_;  // by state: the position where it was last met
    std::vector<int> open_;
};

}  // namespace

bool matches(std::string_view pattern, std::string_view text) {
    Compiler compiled(pattern);
    Front front(compiled.states, text);
    for (size_t at = 0; at <= text.size(); ++at) {
        std::vector<int> before = std::move(front.waiting);
        front.waiting.clear();
        for (int k : before) {
            const State& state = compiled.states[size_t(k)];
            if (state.set[uint8_t(text[at - 1])] && front.add(state.next, at)) return true;
        }
        if (front.add(compiled.start, at)) return true;
    }
    return false;
}

}  // namespace kinora::rsl
