#pragma once

#include "server/text_sink.h"
#include "solver/scene/light.h"

#include <string>
#include <string_view>

namespace patchlight::server {

/// A text as a field of a CSV file: in quotes where it needs them (RFC 4180).
std::string csv_field(std::string_view text);

/// Comma-separated values, handed on in large pieces. Texts are quoted where they need it, as
/// Shafranovich, RFC 4180, "Common Format and MIME Type for CSV Files", 2005 has it; but lines end
/// in "\n" alone, as programs of today write and read them. Numbers are the shortest that read
/// back as the same.
class CsvTable {
  public:
    CsvTable(std::string_view header, TextSink sink);

    CsvTable& text(std::string_view field);
    CsvTable& number(double field);
    CsvTable& number(std::size_t field);
    CsvTable& numbers(const Vec3& fields);
    CsvTable& numbers(const Rgb& fields);
    void end_row();

    /// Hands on what is left.
    void finish();

  private:
    void begin_field();

    TextSink sink_;
    std::string pending_;
    bool is_first_ = true;  // of its row
};

}  // namespace patchlight::server
