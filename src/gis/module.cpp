// SPDX-License-Identifier: MIT
// The entry of the module that reads rasters by GDAL.
#include "hyoryu/core/error.hpp"
#include "hyoryu/geometry/raster_module.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include <cpl_error.h>
#include <gdal.h>
#include <ogr_srs_api.h>

namespace hyoryu {

namespace {

constexpr double most_cells = 2e8;

struct Closing {
    void operator()(GDALDatasetH file) const { GDALClose(file); }
};
using Dataset = std::unique_ptr<void, Closing>;

// GDAL tells its errors to the terminal unless they are kept quiet.
class Quiet {
public:
    Quiet() { CPLPushErrorHandler(CPLQuietErrorHandler); }
    ~Quiet() { CPLPopErrorHandler(); }
    Quiet(const Quiet&) = delete;
    Quiet& operator=(const Quiet&) = delete;
};

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& fault)
{
    throw IoError(fmt::format("{}: {}", file.string(), fault));
}

Dataset open_raster(const std::filesystem::path& file)
{
    GDALAllRegister();
    Dataset raster(
        GDALOpenEx(file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, nullptr, nullptr, nullptr));
    if (!raster) {
        refuse(file, fmt::format("GDAL cannot read it: {}", CPLGetLastErrorMsg()));
    }
    const double columns = GDALGetRasterXSize(raster.get());
    const double rows = GDALGetRasterYSize(raster.get());
    if (GDALGetRasterCount(raster.get()) != 1) {
        refuse(file, fmt::format("it has {} bands, expected one of heights; `gdal_translate -b 1` "
                                 "extracts the first",
                                 GDALGetRasterCount(raster.get())));
    }
    if (columns < 2 || rows < 2 || columns * rows > most_cells) {
        refuse(file,
               fmt::format("a grid of {} x {} cells is not supported, expected at least 2 x 2 "
                           "and at most {:.0e} cells",
                           columns, rows, most_cells));
    }
    return raster;
}

void check_map(const std::filesystem::path& file, GDALDatasetH raster, const HeightGrid& grid)
{
    constexpr double degrees = 0.01; // a cell of one centimetre, or of a kilometre
    const OGRSpatialReferenceH map = GDALGetSpatialRef(raster);
    const bool angles = map != nullptr
                            ? OSRIsGeographic(map) != 0
                            : std::max(grid.cell[0], grid.cell[1]) < degrees &&
                                  std::abs(grid.first[0]) <= 360 && std::abs(grid.first[1]) <= 360;
    if (angles) {
        refuse(file, "the grid is in degrees; reproject it to metres, for instance by `gdalwarp "
                     "-t_srs EPSG:32654`");
    }
    if (map != nullptr && OSRIsProjected(map) != 0) {
        const double unit = OSRGetLinearUnits(map, nullptr);
        if (std::abs(unit - 1) > 1e-9) {
            refuse(file, fmt::format("its map projection has units of {:.7g} m, expected metres; "
                                     "`gdalwarp -t_srs EPSG:32654` reprojects it",
                                     unit));
        }
    }
}

// Cells of a raster that is not turned; its first row is the northern one, or the southern one.
void place(const std::filesystem::path& file, GDALDatasetH raster, HeightGrid& grid)
{
    std::array<double, 6> t{}; // easting = t0 + t1 column + t2 row, northing = t3 + ...
    if (GDALGetGeoTransform(raster, t.data()) != CE_None) {
        refuse(file, "it is not georeferenced; `gdal_translate -a_ullr` assigns coordinates to it");
    }
    if (t[2] != 0 || t[4] != 0 || !(t[1] > 0) || t[5] == 0) {
        refuse(file, "its rows do not run from west to east; `gdalwarp` reorients it");
    }
    grid.columns = GDALGetRasterXSize(raster);
    grid.rows = GDALGetRasterYSize(raster);
    grid.cell = {t[1], std::abs(t[5])};
    const double last = t[5] > 0 ? 0 : static_cast<double>(grid.rows);
    grid.first = {t[0] + t[1] / 2, t[3] + t[5] * last + grid.cell[1] / 2};
    if (t[5] > 0) {
        return;
    }
    std::vector<double> turned(grid.height.size()); // from the southern row
    const auto columns = static_cast<std::size_t>(grid.columns);
    for (std::size_t row = 0; row * columns < turned.size(); ++row) {
        std::copy_n(grid.height.end() - static_cast<std::ptrdiff_t>((row + 1) * columns), columns,
                    turned.begin() + static_cast<std::ptrdiff_t>(row * columns));
    }
    grid.height = std::move(turned);
}

std::vector<double> heights_of(const std::filesystem::path& file, GDALDatasetH raster,
                               double substitute)
{
    const int columns = GDALGetRasterXSize(raster);
    const int rows = GDALGetRasterYSize(raster);
    std::vector<double> heights(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    const GDALRasterBandH band = GDALGetRasterBand(raster, 1);
    if (GDALRasterIO(band, GF_Read, 0, 0, columns, rows, heights.data(), columns, rows, GDT_Float64,
                     0, 0) != CE_None) {
        refuse(file, fmt::format("GDAL cannot read it: {}", CPLGetLastErrorMsg()));
    }
    int has_none = 0;
    const double none = GDALGetRasterNoDataValue(band, &has_none);
    int scaled = 0;
    const double factor = GDALGetRasterScale(band, &scaled);
    const double offset = GDALGetRasterOffset(band, nullptr);
    for (double& z : heights) {
        const bool missing = !std::isfinite(z) || (has_none != 0 && z == none);
        z = missing ? substitute : scaled != 0 ? factor * z + offset : z;
    }
    return heights;
}

} // namespace

} // namespace hyoryu

extern "C" {

[[gnu::visibility("default")]] void hyoryu_module_read_raster(const std::filesystem::path& file,
                                                              double substitute,
                                                              hyoryu::HeightGrid& grid)
{
    const hyoryu::Quiet quiet;
    const hyoryu::Dataset raster = hyoryu::open_raster(file);
    grid.height = hyoryu::heights_of(file, raster.get(), substitute);
    hyoryu::place(file, raster.get(), grid);
    hyoryu::check_map(file, raster.get(), grid);
}

} // extern "C"
