#include "server/trace/hemicube_pictures.h"

#include "raster/colour_map.h"
#include "raster/colour_scale.h"

#include <algorithm>

namespace patchlight::server {
namespace {

constexpr int least_edge = 384;  // of a picture of the top face [pixels]

/// A picture of cells: each a square of some pixels.
class CellPicture {
  public:
    CellPicture(int columns, int rows, int pixels, const Eigen::Array3d& background)
        : pixels_(pixels) {
        image_.width = columns * pixels;
        image_.height = rows * pixels;
        image_.rgb.resize(3 * static_cast<std::size_t>(image_.width) *
                          static_cast<std::size_t>(image_.height));
        for (std::size_t k = 0; k < image_.rgb.size(); ++k)
            image_.rgb[k] = static_cast<float>(background[static_cast<Eigen::Index>(k % 3)]);
    }
    void set(int column, int row, const Eigen::Array3d& colour) {
        for (int y = row * pixels_; y < (row + 1) * pixels_; ++y)
            for (int x = column * pixels_; x < (column + 1) * pixels_; ++x)
                for (int c = 0; c < 3; ++c)
                    image_.rgb[static_cast<std::size_t>(3 * (y * image_.width + x) + c)] =
                        static_cast<float>(colour[c]);
    }
    raster::Image take() { return std::move(image_); }

  private:
    int pixels_;
    raster::Image image_;
};

int pixels_per_cell(int width) { return std::max(1, (least_edge + width - 1) / width); }

Eigen::Array3d colour_of(std::uint32_t seen, const PatchColours& colours) {
    if (seen == HemicubeFace::nothing) return Eigen::Array3d::Zero();
    if (seen == HemicubeFace::back) return Eigen::Array3d::Constant(0.05);
    return colours.of(seen);
}

/// Column and row in the unfolded picture of a cell of a face. Left of the top lies the side
/// towards +x, for one looks up at it.
std::array<int, 2> unfolded_place(std::size_t face, int column, int row, int width, int height) {
    switch (face) {
        case 0:
            return {height + column, height + row};
        case 1:  // +x: its upper edge turned to the right
            return {height - 1 - row, height + column};
        case 2:  // -x: to the left
            return {height + width + row, height + width - 1 - column};
        case 3:  // +y: above, upside down
            return {height + width - 1 - column, height - 1 - row};
        default:  // -y: below
            return {height + column, height + width + row};
    }
}

template <class Colour>
raster::Image unfolded(const std::array<HemicubeFace, 5>& faces, const Colour& colour) {
    const int width = faces[0].width, height = faces[1].height, edge = width + 2 * height;
    CellPicture picture(edge, edge, std::max(1, pixels_per_cell(edge)),
                        Eigen::Array3d::Constant(raster::background_grey));
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (int row = 0; row < faces[f].height; ++row)
            for (int column = 0; column < width; ++column) {
                const auto place = unfolded_place(f, column, row, width, height);
                const auto cell = static_cast<std::size_t>(row * width + column);
                picture.set(place[0], place[1], colour(faces[f], cell));
            }
    return picture.take();
}

}  // namespace

std::array<raster::Image, 5> face_pictures(const std::array<HemicubeFace, 5>& faces,
                                           const PatchColours& colours) {
    std::array<raster::Image, 5> pictures;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const HemicubeFace& face = faces[f];
        CellPicture picture(face.width, face.height, pixels_per_cell(face.width),
                            Eigen::Array3d::Zero());
        for (int row = 0; row < face.height; ++row)
            for (int column = 0; column < face.width; ++column)
                picture.set(
                    column, row,
                    colour_of(face.seen[static_cast<std::size_t>(row * face.width + column)],
                              colours));
        pictures[f] = picture.take();
    }
    return pictures;
}

raster::Image unfolded_patches(const std::array<HemicubeFace, 5>& faces,
                               const PatchColours& colours) {
    return unfolded(faces, [&](const HemicubeFace& face, std::size_t cell) {
        return colour_of(face.seen[cell], colours);
    });
}

raster::Image unfolded_delta_factors(const std::array<HemicubeFace, 5>& faces) {
    double most = 0.0;
    for (const HemicubeFace& face : faces)
        for (const double delta : face.delta_factors) most = std::max(most, delta);
    const raster::Image picture = unfolded(faces, [&](const HemicubeFace& face, std::size_t cell) {
        return raster::mapped_colour(face.delta_factors[cell] / most);
    });
    return raster::with_colour_scale(picture, {{0.0, most}, {"delta", "form factor"}});
}

}  // namespace patchlight::server
