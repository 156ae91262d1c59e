// SPDX-License-Identifier: MIT
// Sorting of points into tiles: cell keys from Morton numbers of the tiles and a Hilbert curve
// within each tile, ordered by a parallel radix sort.
#include "hyoryu/core/tiles.hpp"

#include "hyoryu/core/parallel.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace hyoryu {

namespace {

constexpr int cell_bits = 6; // of a cell number, within its tile
constexpr std::uint64_t outside = ~std::uint64_t(0);

// `spread` inserts two zero bits after each of the lowest 21 bits; `gather` is the inverse.
std::uint64_t spread(std::uint64_t a)
{
    a &= 0x1fffff;
    a = (a | a << 32) & 0x1f00000000ffff;
    a = (a | a << 16) & 0x1f0000ff0000ff;
    a = (a | a << 8) & 0x100f00f00f00f00f;
    a = (a | a << 4) & 0x10c30c30c30c30c3;
    a = (a | a << 2) & 0x1249249249249249;
    return a;
}
std::uint64_t gather(std::uint64_t a)
{
    a &= 0x1249249249249249;
    a = (a | a >> 2) & 0x10c30c30c30c30c3;
    a = (a | a >> 4) & 0x100f00f00f00f00f;
    a = (a | a >> 8) & 0x1f0000ff0000ff;
    a = (a | a >> 16) & 0x1f00000000ffff;
    a = (a | a >> 32) & 0x1fffff;
    return a;
}

std::uint64_t interleave(const std::array<std::int64_t, 3>& a)
{
    return spread(static_cast<std::uint64_t>(a[0])) |
           spread(static_cast<std::uint64_t>(a[1])) << 1 |
           spread(static_cast<std::uint64_t>(a[2])) << 2;
}

// Position of each cell of a tile, numbered x + 4 y + 16 z, along a Hilbert curve of two levels.
// Consecutive cells touch, so that eight consecutive points fill a small box. Source: Skilling
// (2004), Programming the Hilbert curve.
constexpr std::array<std::uint8_t, 64> hilbert_order()
{
    std::array<std::uint8_t, 64> order{};
    for (unsigned cell = 0; cell < 64; ++cell) {
        unsigned a[3] = {cell & 3, cell >> 2 & 3, cell >> 4};
        for (unsigned& axis : a) { // undo the turns of the upper level
            const unsigned turn = (axis & 2) != 0 ? 1 : 0;
            const unsigned swap = turn != 0 ? 0 : (a[0] ^ axis) & 1;
            a[0] ^= turn | swap;
            axis ^= swap;
        }
        a[1] ^= a[0]; // Gray code
        a[2] ^= a[1];
        const unsigned flip = (a[2] & 2) != 0 ? 1 : 0;
        unsigned index = 0;
        for (const unsigned bit : {1U, 0U}) {
            for (const unsigned axis : a) {
                index = index << 1 | ((axis ^ flip) >> bit & 1);
            }
        }
        order[cell] = static_cast<std::uint8_t>(index);
    }
    return order;
}
constexpr std::array<std::uint8_t, 64> place_along_curve = hilbert_order();

// Resizes a vector without spare capacity; a vector that grows by itself doubles its capacity.
template <class T>
void make_room(std::vector<T>& values, std::size_t count)
{
    values.reserve(count);
    values.resize(count);
}

// Stable sort by digits of 11 bits. Every chunk of rows counts its digits; prefix sums then give
// each chunk the places of its rows. The chunks run in parallel, and their number does not depend
// on the number of threads.
class RadixSort {
public:
    RadixSort(SortSpace& space, Index count) : space_(space), count_(count)
    {
        chunks_ = std::clamp<Index>(count / 8192, 1, 64);
        make_room(space_.key_swap, space_.key.size());
        make_room(space_.row_swap, space_.row.size());
        space_.histogram.resize(at(chunks_ * digits));
    }
    void sort()
    {
        const auto differ = reduce(
            0, count_, std::uint64_t(0), [&](Index k) { return space_.key[at(k)] ^ space_.key[0]; },
            [](std::uint64_t a, std::uint64_t b) { return a | b; });
        for (int shift = 0; shift < static_cast<int>(std::bit_width(differ)); shift += bits) {
            if ((differ >> shift) % digits != 0) {
                pass(shift);
            }
        }
    }

private:
    static constexpr int bits = 11;
    static constexpr Index digits = Index(1) << bits;

    Index digit(Index k, int shift) const
    {
        return static_cast<Index>(space_.key[at(k)] >> shift) & (digits - 1);
    }
    void pass(int shift)
    {
        const Index length = (count_ + chunks_ - 1) / chunks_;
        const auto over_chunk = [&](Index chunk, const auto& f) {
            std::int32_t* const counts = &space_.histogram[at(chunk * digits)];
            const Index end = std::min(count_, (chunk + 1) * length);
            for (Index k = chunk * length; k < end; ++k) {
                f(k, counts[digit(k, shift)]);
            }
        };
        parallel_blocks(
            0, chunks_,
            [&](Index chunk) {
                std::fill_n(&space_.histogram[at(chunk * digits)], digits, 0);
                over_chunk(chunk, [](Index, std::int32_t& count) { ++count; });
            },
            2);
        std::int32_t place = 0;
        for (Index digit = 0; digit < digits; ++digit) {
            for (Index chunk = 0; chunk < chunks_; ++chunk) {
                place += std::exchange(space_.histogram[at(chunk * digits + digit)], place);
            }
        }
        parallel_blocks(
            0, chunks_,
            [&](Index chunk) {
                over_chunk(chunk, [&](Index k, std::int32_t& next) {
                    const auto to = at(next++);
                    space_.key_swap[to] = space_.key[at(k)];
                    space_.row_swap[to] = space_.row[at(k)];
                });
            },
            2);
        space_.key.swap(space_.key_swap);
        space_.row.swap(space_.row_swap);
    }

    SortSpace& space_;
    Index count_;
    Index chunks_ = 1;
};

// Sorts the rows of each cell by the numbers of their points. A block of keys handles the cells
// that begin in it, so that each cell has one writer.
void order_cells(SortSpace& space, Index count, std::span<const std::int64_t> id)
{
    constexpr Index block = 1024;
    const auto number = [&](std::int32_t row) { return id[row]; };
    parallel_blocks(
        0, (count + block - 1) / block,
        [&](Index b) {
            Index first = b * block;
            while (first > 0 && first < count && space.key[at(first)] == space.key[at(first - 1)]) {
                ++first;
            }
            while (first < std::min(count, (b + 1) * block)) {
                Index last = first + 1;
                while (last < count && space.key[at(last)] == space.key[at(first)]) {
                    ++last;
                }
                std::ranges::sort(space.row.begin() + first, space.row.begin() + last, {}, number);
                first = last;
            }
        },
        2);
}

void find_tiles(Tiles& tiles, const SortSpace& space, Index count)
{
    tiles.tile.clear();
    tiles.start.clear();
    for (Index k = 0; k < count; ++k) {
        const std::uint64_t number = space.key[at(k)] >> cell_bits;
        if (tiles.tile.empty() || number != tiles.tile.back()) {
            tiles.tile.push_back(number);
            tiles.start.push_back(static_cast<std::int32_t>(k));
        }
    }
    tiles.start.push_back(static_cast<std::int32_t>(count));
}

// A point less a number of periods along each axis, which `whole` makes of its way from another in
// periods: the image is as exact as the point.
Vec3 less_periods(const TileLattice& lattice, const Vec3& point, const Vec3& other,
                  const auto& whole)
{
    Vec3 image = point;
    for (Index axis = 0; axis < 3; ++axis) {
        const auto tiles = lattice.period[axis];
        if (tiles > 0) {
            const real length = static_cast<real>(tiles) * lattice.edge[axis];
            image[axis] -= length * whole((point[axis] - other[axis]) / length);
        }
    }
    return image;
}

} // namespace

std::uint64_t TileLattice::cell_of(const Vec3& point) const
{
    const Vec3 scaled = (point - origin).cwiseProduct((cells / edge.array()).matrix());
    std::array<std::int64_t, 3> tile{};
    std::int64_t cell = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        auto place =
            static_cast<std::int64_t>(std::floor(scaled[static_cast<Index>(axis)])) + reach;
        if (period[axis] > 0) { // a point that rounding puts past the end belongs to the last cell
            place = std::min(place, reach + cells * period[axis] - 1);
        }
        tile[axis] = place / cells;
        cell += (place % cells) << (2 * axis);
    }
    return interleave(tile) << cell_bits | place_along_curve[cell];
}

std::uint64_t TileLattice::tile_of(const Vec3& point) const
{
    return tile_of_cell(cell_of(point));
}

std::uint64_t TileLattice::tile_of_cell(std::uint64_t cell)
{
    return cell >> cell_bits;
}

std::array<std::int64_t, 3> TileLattice::place_of(std::uint64_t tile)
{
    std::array<std::int64_t, 3> place{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        place[axis] = static_cast<std::int64_t>(gather(tile >> axis)) - reach / cells;
    }
    return place;
}

std::uint64_t TileLattice::tile_at(const std::array<std::int64_t, 3>& place)
{
    return interleave(
        {place[0] + reach / cells, place[1] + reach / cells, place[2] + reach / cells});
}

Vec3 TileLattice::centre(std::uint64_t tile) const
{
    const auto place = place_of(tile);
    return origin + edge.cwiseProduct(Vec3(static_cast<real>(place[0]) + 0.5,
                                           static_cast<real>(place[1]) + 0.5,
                                           static_cast<real>(place[2]) + 0.5));
}

std::uint64_t TileLattice::beside(const std::array<std::int64_t, 3>& place,
                                  const std::array<int, 3>& way) const
{
    std::array<std::int64_t, 3> there{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        there[axis] = place[axis] + way[axis];
        if (period[axis] > 0) {
            there[axis] = (there[axis] + period[axis]) % period[axis];
        }
    }
    return tile_at(there);
}

Vec3 TileLattice::wrapped(const Vec3& point) const
{
    return less_periods(*this, point, origin, [](real periods) { return std::floor(periods); });
}

Vec3 TileLattice::image_near(const Vec3& point, const Vec3& other) const
{
    return less_periods(*this, point, other, [](real periods) { return std::round(periods); });
}

Vec3 TileLattice::shortest(const Vec3& r) const
{
    return image_near(r, Vec3::Zero());
}

real TileLattice::unit(int digits) const
{
    // A tile sees points up to one and a half edges from its centre, and a little more once they
    // have moved: two edges must fit into the digits.
    return std::exp2(std::ceil(std::log2(2 * edge.maxCoeff())) - digits);
}

TileLattice make_lattice(const Vec3& origin, real edge, const Vec3& period)
{
    TileLattice lattice{origin, Vec3::Constant(edge)};
    for (Index axis = 0; axis < 3; ++axis) {
        if (period[axis] > 0) {
            const real tiles = std::floor(period[axis] / edge);
            expects(tiles >= 1);
            lattice.period[axis] = static_cast<std::int64_t>(tiles);
            lattice.edge[axis] = period[axis] / tiles;
        }
    }
    const real unit = lattice.unit(std::numeric_limits<float>::digits);
    lattice.edge = (lattice.edge.array() / unit).ceil() * unit;
    return lattice;
}

Index Tiles::find(std::uint64_t number) const
{
    const auto found = std::lower_bound(tile.begin(), tile.end(), number);
    return found != tile.end() && *found == number ? found - tile.begin() : -1;
}

Index sort_rows(const TileLattice& lattice, const NumberedPoints& points, const Vec3& low,
                const Vec3& high, SortSpace& space)
{
    const auto n = static_cast<Index>(points.x.size());
    expects(points.id.size() == points.x.size());
    make_room(space.key, at(n));
    make_room(space.row, at(n));
    if (n == 0) {
        return 0;
    }
    parallel_for(0, n, [&](Index k) {
        const Vec3& point = points.x[at(k)];
        const bool inside =
            (point.array() >= low.array()).all() && (point.array() <= high.array()).all();
        space.key[at(k)] = inside ? lattice.cell_of(point) : outside;
        space.row[at(k)] = static_cast<std::int32_t>(k);
    });
    RadixSort(space, n).sort();
    const Index inside =
        std::lower_bound(space.key.begin(), space.key.end(), outside) - space.key.begin();
    order_cells(space, inside, points.id);
    return inside;
}

void make_tiles(Tiles& tiles, const TileLattice& lattice, std::span<const Vec3> x,
                const SortSpace& space, Index count)
{
    tiles.lattice = lattice;
    find_tiles(tiles, space, count);
    tiles.row.assign(space.row.begin(), space.row.begin() + count);
    for (std::vector<float>* column : {&tiles.x, &tiles.y, &tiles.z}) {
        column->resize(at(count));
    }
    parallel_blocks(0, tiles.tiles(), [&](Index t) {
        const Vec3 centre = lattice.centre(tiles.tile[at(t)]);
        for (Index k = tiles.start[at(t)]; k < tiles.start[at(t + 1)]; ++k) {
            const Vec3 r = x[at(tiles.row[at(k)])] - centre;
            tiles.x[at(k)] = static_cast<float>(r.x());
            tiles.y[at(k)] = static_cast<float>(r.y());
            tiles.z[at(k)] = static_cast<float>(r.z());
        }
    });
    bound_chunks(tiles);
}

void bound_chunks(Tiles& tiles)
{
    tiles.chunk_start.resize(tiles.start.size());
    std::int32_t chunks = 0;
    for (std::size_t t = 0; t < tiles.tile.size(); ++t) {
        tiles.chunk_start[t] = chunks;
        chunks += (tiles.start[t + 1] - tiles.start[t] + chunk_slots - 1) / chunk_slots;
    }
    tiles.chunk_start.back() = chunks;
    tiles.box.resize(at(chunks));
    parallel_blocks(0, tiles.tiles(), [&](Index t) {
        Index chunk = tiles.chunk_start[at(t)];
        for (Index k = tiles.start[at(t)]; k < tiles.start[at(t + 1)]; k += chunk_slots) {
            const Index end = std::min<Index>(k + chunk_slots, tiles.start[at(t + 1)]);
            ChunkBox& box = tiles.box[at(chunk++)];
            std::size_t axis = 0;
            for (const std::vector<float>* column : {&tiles.x, &tiles.y, &tiles.z}) {
                const auto [low, high] =
                    std::minmax_element(column->begin() + k, column->begin() + end);
                box.low[axis] = *low;
                box.high[axis] = *high;
                ++axis;
            }
        }
    });
}

} // namespace hyoryu
