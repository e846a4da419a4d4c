#pragma once

namespace patchlight {

/// Form factor between directly opposed, parallel rectangles x × y at distance z.
/// Howell, "A Catalog of Radiation Configuration Factors", 1982, C-11.
double parallel_rectangles(double x, double y, double z);

/// Form factor from the rectangle `width` × `edge` to the rectangle `height` × `edge` that stands
/// on their common edge at a right angle. Howell, C-14.
double perpendicular_rectangles(double edge, double width, double height);

}  // namespace patchlight
