// runtime/programs/validate/batch.cpp: files on several threads, their reports in order.
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <mutex>
#include <new>
#include <thread>

#include "runtime/base/stats.h"
#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/validate/kinora_validate.h"
#include "runtime/programs/validate/output_file.h"
#include "runtime/programs/validate/report.h"

namespace kinora {

namespace {

constexpr size_t kReadAhead = 64;  // files a thread, past the one that is to be printed next

// A piece of the report and what it adds to the totals.
struct Piece {
    std::string text;
    ValidateTotals totals;
    bool done = false;
};

// Files are taken in order; a thread that runs too far ahead of the printer waits, so that memory
// is bounded however long one file takes.
class Queue {
  public:
    Queue(size_t count, size_t window) : pieces_(count), window_(window) {}

    // The number of the next file to do, or nothing.
    std::optional<size_t> take() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return stopped_ || taken_ < printed_ + window_; });
        if (stopped_ || taken_ == pieces_.size()) return std::nullopt;
        return taken_++;
    }
    void finish(size_t index, Piece piece) {
        piece.done = true;
        std::lock_guard lock(mutex_);
        pieces_[index] = std::move(piece);
        if (index == printed_) changed_.notify_all();  // the printer waits for this one
    }
    Piece wait_for(size_t index) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return pieces_[index].done; });
        if (taken_ == printed_ + window_) changed_.notify_all();  // threads wait for room
        printed_ = index + 1;
        return std::move(pieces_[index]);
    }
    void stop() {
        std::lock_guard lock(mutex_);
        stopped_ = true;
        changed_.notify_all();
    }

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Piece> pieces_;
    size_t window_, taken_ = 0, printed_ = 0;
    bool stopped_ = false;
};

// On any thread: nothing below it could pass the exception on.
Piece make_piece(const std::string& file, const ValidateSettings& settings,
                 const std::string& stdin_bytes) try {
    FileResult result = validate_file(file, settings, stdin_bytes);
    Piece piece;
    piece.totals.add(result, settings);
    piece.text = settings.format->file(result, settings);
    return piece;
} catch (const std::bad_alloc&) {
    fmt::print(stderr, "kinora-validate: out of memory at '{}'\n", file);
    std::_Exit(kExitRetry);
}

void add(ValidateTotals& sum, const ValidateTotals& one) {
    sum.files += one.files;
    sum.failed += one.failed;
    sum.incomplete += one.incomplete;
    sum.unreadable += one.unreadable;
    sum.bytes += one.bytes;
    for (size_t s = 0; s < sum.counts.size(); ++s) sum.counts[s] += one.counts[s];
}

void print_stats(const ValidateTotals& totals, double ms, const ValidateSettings& settings) {
    double seconds = std::max(ms, 1e-3) * 1e-3;
    double files = double(totals.files) / seconds, mb = double(totals.bytes) * 1e-6 / seconds;
    if (settings.stats_json)
        fmt::print(stderr,
                   "{{\"files\": {}, \"bytes\": {}, \"ms\": {:.3f}, \"files_per_second\": {:.1f}, "
                   "\"mb_per_second\": {:.2f}, \"threads\": {}, \"peak_bytes\": {}}}\n",
                   totals.files, totals.bytes, ms, files, mb, settings.threads,
                   peak_memory_bytes());
    else
        fmt::print(stderr,
                   "{} in {:.1f} ms: {:.0f} files/s, {:.1f} MB/s, {}, peak memory {:.1f} MB\n",
                   counted(totals.files, "file"), ms, files, mb,
                   counted(size_t(settings.threads), "thread"), double(peak_memory_bytes()) * 1e-6);
}

// Prints pieces in order, until the reader goes away. `piece_of` gives them by their number.
template <class PieceOf>
ValidateTotals print_report(PieceOf piece_of, size_t count, const ValidateSettings& settings,
                            OutputFile& out) {
    const ReportFormat& format = *settings.format;
    ValidateTotals totals;
    bool any = false;
    out.write(format.head(settings));
    for (size_t i = 0; i < count && out.good(); ++i) {
        Piece piece = piece_of(i);
        add(totals, piece.totals);
        if (piece.text.empty()) continue;
        if (any) out.write(format.separator);
        out.write(piece.text);
        any = true;
    }
    out.write(format.tail(totals, settings));
    return totals;
}

// Threads make the pieces, this one prints them.
template <class PieceOf>
ValidateTotals print_threaded(PieceOf piece_of, size_t threads, size_t count,
                              const ValidateSettings& settings, OutputFile& out) {
    Queue queue(count, kReadAhead * threads);
    auto work = [&] {
        while (auto index = queue.take()) queue.finish(*index, piece_of(*index));
    };
    struct Workers : std::vector<std::thread> {
        explicit Workers(Queue& of) : queue(of) {}
        ~Workers() {
            queue.stop();
            for (std::thread& worker : *this) worker.join();
        }
        Queue& queue;
    } workers(queue);
    for (size_t t = 0; t < threads; ++t) workers.emplace_back(work);
    return print_report([&](size_t i) { return queue.wait_for(i); }, count, settings, out);
}

}  // namespace

int validate_batch(const ValidateSettings& settings, const std::vector<std::string>& files) {
    Stopwatch watch;
    OutputFile out(settings.output);
    std::string stdin_bytes;
    for (const std::string& file : files)
        if (file == "-" && stdin_bytes.empty()) stdin_bytes = read_stdin();
    size_t threads = std::min(size_t(settings.threads), files.size());
    auto piece_of = [&](size_t i) { return make_piece(files[i], settings, stdin_bytes); };
    ValidateTotals totals = threads > 1
                                ? print_threaded(piece_of, threads, files.size(), settings, out)
                                : print_report(piece_of, files.size(), settings, out);
    if (settings.stats) print_stats(totals, watch.ms(), settings);
    if (!out.close()) return kExitUnwritable;
    return totals.exit_code();
}

}  // namespace kinora
