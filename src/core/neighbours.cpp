// SPDX-License-Identifier: MIT
#include "hyoryu/core/neighbours.hpp"

#include "hyoryu/core/vec.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// All points that may be near any place of one cell of a grid, side by side, so that the rows of a
// cell share them and each row is one straight loop.
class Candidates {
public:
    explicit Candidates(real radius) : radius_(radius) {}

    /// Gathers what is near the cell of the point, unless it is there already.
    void gather(std::span<const CellGrid* const> grids, const Vec3& point);
    /// Appends the rows within the radius of the point; `out` has room for all of them.
    std::int32_t* append_near(const Vec3& point, std::int32_t* out);
    std::size_t size() const { return count_; }

private:
    void add(const CellGrid& grid);
    void add_run(const CellGrid& grid, std::int32_t begin, std::int32_t end, const Vec3& low);

    real radius_;
    Vec3 origin_{infinity, 0, 0}; // of the cell; positions are relative to it [m]
    real cell_ = 0;
    float slack_ = 0;
    std::size_t count_ = 0; // of candidates; the columns have room for more
    std::vector<float> x_, y_, z_, squared_;
    std::vector<std::int32_t> row_;
};

void Candidates::gather(std::span<const CellGrid* const> grids, const Vec3& point)
{
    const Vec3 inside = point - origin_;
    if ((inside.array() >= 0).all() && (inside.array() < cell_).all()) {
        return;
    }
    // Cells of the first grid that has any: the rows of a destination come in their order.
    const CellGrid* frame = grids.front();
    for (const CellGrid* grid : grids) {
        frame = frame->order.empty() ? grid : frame;
    }
    cell_ = frame->cell;
    origin_ = frame->origin + cell_ * ((point - frame->origin) / cell_).array().floor().matrix();
    slack_ = 0;
    count_ = 0;
    for (const CellGrid* grid : grids) {
        if (!grid->order.empty()) {
            add(*grid);
        }
    }
}

void Candidates::add(const CellGrid& grid)
{
    slack_ = std::max(slack_, grid.slack);
    const real reach = radius_ + grid.slack;
    std::array<Index, 3> lo{};
    std::array<Index, 3> hi{};
    const Vec3 low = origin_ - grid.origin;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        lo[a] = std::max<Index>(static_cast<Index>(std::floor((low[axis] - reach) / grid.cell)), 0);
        hi[a] =
            std::min<Index>(static_cast<Index>(std::floor((low[axis] + cell_ + reach) / grid.cell)),
                            grid.count[a] - 1);
        if (lo[a] > hi[a]) {
            return;
        }
    }
    for (Index cz = lo[2]; cz <= hi[2]; ++cz) {
        for (Index cy = lo[1]; cy <= hi[1]; ++cy) {
            const Index row = grid.count[0] * (cy + grid.count[1] * cz);
            const std::int32_t begin = grid.start[static_cast<std::size_t>(row + lo[0])];
            const std::int32_t end = grid.start[static_cast<std::size_t>(row + hi[0]) + 1];
            add_run(grid, begin, end, low);
        }
    }
}

void Candidates::add_run(const CellGrid& grid, std::int32_t begin, std::int32_t end,
                         const Vec3& low)
{
    const auto n = static_cast<std::size_t>(end - begin);
    if (count_ + n > row_.size()) {
        for (std::vector<float>* column : {&x_, &y_, &z_, &squared_}) {
            column->resize(2 * (count_ + n));
        }
        row_.resize(2 * (count_ + n));
    }
    const auto copy = [&](const std::vector<float>& from, double shift, std::vector<float>& to) {
        const float* const source = from.data() + begin;
        float* const target = to.data() + count_;
        const auto offset = static_cast<float>(shift);
        for (std::size_t k = 0; k < n; ++k) {
            target[k] = source[k] - offset;
        }
    };
    copy(grid.x, low.x(), x_);
    copy(grid.y, low.y(), y_);
    copy(grid.z, low.z(), z_);
    std::copy_n(grid.order.data() + begin, n, row_.data() + count_);
    count_ += n;
}

std::int32_t* Candidates::append_near(const Vec3& point, std::int32_t* out)
{
    const Vec3 offset = point - origin_;
    const float px = static_cast<float>(offset.x());
    const float py = static_cast<float>(offset.y());
    const float pz = static_cast<float>(offset.z());
    const std::size_t n = count_;
    const float* const x = x_.data();
    const float* const y = y_.data();
    const float* const z = z_.data();
    float* const squared = squared_.data();
    for (std::size_t k = 0; k < n; ++k) {
        squared[k] = sq(x[k] - px) + sq(y[k] - py) + sq(z[k] - pz);
    }
    // Branch-free: every candidate is written and the end moves on if it is near.
    const float limit = sq(static_cast<float>(radius_) + 2 * slack_);
    const std::int32_t* const row = row_.data();
    for (std::size_t k = 0; k < n; ++k) {
        *out = row[k];
        out += squared[k] <= limit ? 1 : 0;
    }
    return out;
}

// Takes the rows of one owner out of the entries from `begin` on; returns the new number of
// entries.
std::size_t without_kin(std::vector<std::int32_t>& entries, std::size_t begin, std::size_t end,
                        std::span<const std::int32_t> owner, Index row)
{
    const std::int32_t own = owner[static_cast<std::size_t>(row)];
    const auto first = entries.begin();
    const auto kept =
        std::remove_if(first + static_cast<Index>(begin), first + static_cast<Index>(end),
                       [&](std::int32_t j) { return owner[static_cast<std::size_t>(j)] == own; });
    return static_cast<std::size_t>(kept - first);
}

} // namespace

void PairList::build(std::span<const Vec3> x, Rows destination,
                     std::span<const CellGrid* const> sources, real radius,
                     const ListChoice& choice)
{
    rows_ = destination;
    const auto void_row = static_cast<std::int32_t>(x.size());
    const Index blocks = (destination.size() + block_rows - 1) / block_rows;
    blocks_.resize(static_cast<std::size_t>(blocks));
    parallel_blocks(0, blocks, [&](Index b) {
        Block& block = blocks_[static_cast<std::size_t>(b)];
        auto& entries = block.entries;
        Candidates candidates(radius);
        const Index first = destination.begin + b * block_rows;
        const Index last = std::min(destination.end, first + block_rows);
        std::size_t count = 0;
        for (Index i = first; i < last; ++i) {
            const auto row = static_cast<std::size_t>(i);
            block.start[static_cast<std::size_t>(i - first)] = static_cast<std::int32_t>(count);
            if (!choice.wanted.empty() && choice.wanted[row] == 0) {
                continue;
            }
            candidates.gather(sources, x[row]);
            if (count + candidates.size() + lanes > entries.size()) {
                entries.resize(2 * (count + candidates.size() + lanes));
            }
            const std::size_t begin = count;
            count = static_cast<std::size_t>(
                candidates.append_near(x[row], entries.data() + begin) - entries.data());
            if (!choice.owner.empty()) {
                count = without_kin(entries, begin, count, choice.owner, i);
            }
            while (count % lanes != 0) {
                entries[count++] = void_row;
            }
        }
        std::fill(block.start.begin() + (last - first), block.start.end(),
                  static_cast<std::int32_t>(count));
    });
}

void PairList::clear()
{
    rows_ = {};
    blocks_.clear();
}

std::vector<std::uint8_t> PairList::met(Index all_rows) const
{
    std::vector<std::uint8_t> marks(static_cast<std::size_t>(all_rows) + 1,
                                    0); // one for the void row
    for (const Block& block : blocks_) {
        for (std::int32_t k = 0; k < block.start.back(); ++k) {
            marks[static_cast<std::size_t>(block.entries[static_cast<std::size_t>(k)])] = 1;
        }
    }
    return marks;
}

Index PairList::entries() const
{
    Index total = 0;
    for (const Block& block : blocks_) {
        total += block.start.back();
    }
    return total;
}

std::size_t PairList::bytes() const
{
    std::size_t total = blocks_.capacity() * sizeof(Block);
    for (const Block& block : blocks_) {
        total += block.entries.capacity() * sizeof(std::int32_t);
    }
    return total;
}

} // namespace hyoryu
