// tests/mutate.h: damages text at random, for tests that reading survives anything.
#pragma once

#include <random>
#include <string>
#include <vector>

namespace kinora {

// Mutates members of a corpus: bytes, runs of text, words of a dictionary, pieces of other members.
class Mutator {
  public:
    Mutator(std::vector<std::string> corpus, std::vector<std::string> words, uint64_t seed,
            size_t most_edits = 6)
        : corpus_(std::move(corpus)),
          words_(std::move(words)),
          most_edits_(most_edits),
          random_(seed) {}

    std::string next() {
        std::string text = pick(corpus_);
        for (size_t edits = 1 + below(most_edits_); edits > 0; --edits) edit(text);
        return text;
    }

  private:
    size_t below(size_t n) { return random_() % n; }
    const std::string& pick(const std::vector<std::string>& list) {
        return list[below(list.size())];
    }

    // A run that begins somewhere and is short, more often than not.
    struct Run {
        size_t at, length;
    };
    Run run(const std::string& text) {
        size_t at = below(text.size());
        size_t most = below(4) == 0 ? text.size() - at : std::min<size_t>(text.size() - at, 24);
        return {at, most == 0 ? 0 : 1 + below(most)};
    }

    void edit(std::string& text) {
        if (text.empty()) text = " ";
        Run r = run(text);
        switch (below(8)) {
            case 0:
                text[r.at] = static_cast<char>(random_());
                return;
            case 1:
                text.erase(r.at, r.length);
                return;
            case 2:
                text.insert(r.at, text.substr(r.at, r.length));
                return;
            case 3: {
                std::string moved = text.substr(r.at, r.length);
                text.erase(r.at, r.length);
                text.insert(text.empty() ? 0 : below(text.size()), moved);
                return;
            }
            case 4: {
                const std::string& other = pick(corpus_);
                if (other.empty()) return;
                Run from = run(other);
                text.insert(r.at, other.substr(from.at, from.length));
                return;
            }
            case 5:
                text.replace(r.at, r.length, pick(words_));
                return;
            default:
                text.insert(word_end(text, r.at), " " + pick(words_) + " ");
                return;
        }
    }

    static size_t word_end(const std::string& text, size_t at) {
        while (at < text.size() && text[at] != ' ' && text[at] != '(' && text[at] != ';') ++at;
        return at;
    }

    std::vector<std::string> corpus_, words_;
    size_t most_edits_;
    std::mt19937_64 random_;
};

}  // namespace kinora
