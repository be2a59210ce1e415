// runtime/player/board/trade_board.cpp: films kept, errors one after the other.
#include "runtime/player/board/trade_board.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "runtime/base/parallel.h"
#include "runtime/picture/compare/errors.h"
#include "runtime/picture/compare/flip.h"

namespace kinora {

namespace {

PictureView view_of(const raytrace::Film& film) {
    return {film.width, film.height, film.rgba};
}

// The error of linear colors, over pixels and channels; what is not finite is black.
double rmse_of(const raytrace::Film& film, const raytrace::Film& best) {
    auto shown = [](float v) { return std::isfinite(v) ? double(v) : 0.0; };
    double squares = 0;
    for (size_t k = 0; k < film.rgba.size(); ++k)
        for (int c = 0; c < 3; ++c) {
            const double d = shown(film.rgba[k][c]) - shown(best.rgba[k][c]);
            squares += d * d;
        }
    return std::sqrt(squares / double(std::max<size_t>(3 * film.rgba.size(), 1)));
}

}  // namespace

TradeBoard::TradeBoard(std::function<void()> wake)
    : wake_(std::move(wake)), thread_([this] { run(); }) {}

TradeBoard::~TradeBoard() {
    {
        std::lock_guard lock(mutex_);
        quit_ = true;
    }
    wanted_.notify_one();
    thread_.join();
}

void TradeBoard::clear() {
    std::lock_guard lock(mutex_);
    if (rows_.empty()) return;
    rows_.clear();
    ++edition_;
}

void TradeBoard::add(const std::string& name, int rank, double ms,
                     std::shared_ptr<const raytrace::Film> film) {
    {
        std::lock_guard lock(mutex_);
        auto row = std::ranges::find_if(rows_, [&](const Row& r) { return r.stop.rank >= rank; });
        if (row == rows_.end() || row->stop.rank > rank) row = rows_.insert(row, Row{});
        row->stop = {name, rank, ms, "", 0, 0};
        row->film = std::move(film);
        // What is best has no errors; where it is another one, those of all are due.
        const bool best = row == rows_.end() - 1;
        for (Row& other : rows_)
            if (best || &other == &*row) {
                other.due = &other != &rows_.back();
                other.stop.against.clear();
            }
        ++edition_;
    }
    wanted_.notify_one();
}

std::vector<TradeStop> TradeBoard::stops() const {
    std::lock_guard lock(mutex_);
    std::vector<TradeStop> stops;
    for (const Row& row : rows_) stops.push_back(row.stop);
    return stops;
}

bool TradeBoard::idle() const {
    std::lock_guard lock(mutex_);
    return !working_ && std::ranges::none_of(rows_, &Row::due);
}

TradeBoard::Row* TradeBoard::due_row() {
    auto row = std::ranges::find_if(rows_, &Row::due);
    return row == rows_.end() ? nullptr : &*row;
}

void TradeBoard::run() {
    std::unique_lock lock(mutex_);
    while (true) {
        wanted_.wait(lock, [&] { return quit_ || due_row(); });
        if (quit_) return;
        Row& row = *due_row();
        row.due = false;
        const auto film = row.film, best = rows_.back().film;
        const std::string against = rows_.back().stop.name;
        const int rank = row.stop.rank;
        const uint64_t edition = edition_;
        working_ = true;
        lock.unlock();
        double rmse = 0, flip = 0;
        const bool alike = film->width == best->width && film->height == best->height;
        if (alike) {
            SerialScope serial;  // pictures go first
            rmse = rmse_of(*film, *best);
            flip = mean(ldr_flip(view_of(*film), view_of(*best)));
        }
        lock.lock();
        working_ = false;
        if (alike && edition == edition_) {
            for (Row& now : rows_)
                if (now.stop.rank == rank)
                    now.stop.against = against, now.stop.rmse = rmse, now.stop.flip = flip;
        } else if (edition != edition_) {  // rows have come or gone meanwhile
            for (Row& now : rows_) now.due = &now != &rows_.back() && now.stop.against.empty();
        }
        lock.unlock();
        wake_();
        lock.lock();
    }
}

}  // namespace kinora
