// tests/rsl/reduce_text.cpp: greedy reduction of source, from large pieces to small ones.
#include "tests/rsl/reduce_text.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <vector>

namespace kinora::rsl {

namespace {

using Lines = std::vector<std::string>;

std::string joined(const Lines& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
}

Lines split(const std::string& text) {
    Lines lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

class Reducer {
  public:
    Reducer(std::string text, const std::function<bool(const std::string&)>& fails, int trials)
        : text_(std::move(text)), fails_(fails), trials_(trials) {}

    std::string run() {
        for (bool again = true; again && trials_ > 0;) {
            again = drop_blocks();
            again |= drop_runs();
            again |= simplify_groups();
            again |= drop_tails();
        }
        return text_;
    }

  private:
    bool accept(const std::string& smaller) {
        if (smaller == text_ || trials_-- <= 0 || !fails_(smaller)) return false;
        text_ = smaller;
        return true;
    }

    // The line that closes the block opened on line `open`, or 0.
    static size_t closing(const Lines& lines, size_t open) {
        int depth = 0;
        for (size_t k = open; k < lines.size(); ++k) {
            auto begin = std::count(lines[k].begin(), lines[k].end(), '{');
            auto end = std::count(lines[k].begin(), lines[k].end(), '}');
            depth += int(begin - end);
            if (k == open && begin == end) return 0;
            if (depth <= 0) return k;
        }
        return 0;
    }

    bool accept_without(const Lines& lines, size_t begin, size_t end) {
        Lines rest(lines.begin(), lines.begin() + long(begin));
        rest.insert(rest.end(), lines.begin() + long(end), lines.end());
        return accept(joined(rest));
    }

    bool drop_blocks() {
        bool any = false;
        for (size_t k = 0; k < split(text_).size();) {
            Lines lines = split(text_);
            size_t end = lines[k].find('{') == std::string::npos ? 0 : closing(lines, k);
            if (end > k && accept_without(lines, k, end + 1)) {
                any = true;
                continue;
            }
            if (end > k) {
                Lines inner = lines;
                inner.erase(inner.begin() + long(end));
                inner.erase(inner.begin() + long(k));
                if (accept(joined(inner))) {
                    any = true;
                    continue;
                }
            }
            ++k;
        }
        return any;
    }

    bool drop_runs() {
        bool any = false;
        for (size_t run = std::max<size_t>(split(text_).size() / 2, 1); run > 0; run /= 2)
            for (size_t k = split(text_).size(); k-- > 0;) {
                Lines lines = split(text_);
                if (k + run > lines.size()) continue;
                any |= accept_without(lines, k, k + run);
            }
        return any;
    }

    // A parenthesised group, with the name before it or alone, becomes a number or what it holds.
    bool simplify_groups() {
        bool any = false;
        for (size_t open = text_.size(); open-- > 0;) {
            if (open >= text_.size() || text_[open] != '(') continue;
            int depth = 0;
            size_t close = open;
            for (; close < text_.size(); ++close) {
                depth += (text_[close] == '(') - (text_[close] == ')');
                if (depth == 0) break;
            }
            if (close >= text_.size()) continue;
            size_t name = open;
            while (name > 0 && (std::isalnum(static_cast<unsigned char>(text_[name - 1])) ||
                                text_[name - 1] == '_'))
                --name;
            std::string before = text_.substr(0, open), after = text_.substr(close + 1);
            std::string inside = text_.substr(open + 1, close - open - 1);
            for (const std::string& smaller :
                 {text_.substr(0, name) + "1" + after, text_.substr(0, name) + inside + after,
                  before + "(0.5)" + after, before + "(1, 1, 1)" + after}) {
                if (smaller.size() < text_.size() && accept(smaller)) {
                    any = true;
                    break;
                }
            }
        }
        return any;
    }

    // "a op b" to "a" or "b", at every operator between spaces.
    bool drop_tails() {
        bool any = false;
        for (size_t at = text_.size(); at-- > 1;) {
            if (at + 2 >= text_.size() || text_[at] != ' ' || text_[at + 1] == '=') continue;
            size_t end = text_.find_first_of(" ;,)", at + 3);
            if (end == std::string::npos || text_.find('\n', at) < end) continue;
            any |= accept(text_.substr(0, at) + text_.substr(end));
        }
        return any;
    }

    std::string text_;
    const std::function<bool(const std::string&)>& fails_;
    int trials_;
};

}  // namespace

std::string reduce_text(std::string text, const std::function<bool(const std::string&)>& fails,
                        int trials) {
    return Reducer(std::move(text), fails, trials).run();
}

}  // namespace kinora::rsl
