#include "server/files/known_formats.h"

#include "tests/server/files/written_files.h"
#include "tests/server/run_program.h"
#include "tests/server/scene_texts.h"

#include <gtest/gtest.h>

namespace patchlight::server::known_formats_test {
namespace {

void expect_told(const std::string& told, const std::string& format, const std::string& of) {
    EXPECT_NE(told.find(format), std::string::npos) << of << ": " << told;
    EXPECT_NE(told.find("; "), std::string::npos) << of << ": " << told;  // what to do
}

TEST(KnownFormats, AreToldByTheEndingOfAName) {
    const std::pair<const char*, const char*> endings[] = {{"a.ply", "PLY"},
                                                           {"b.FBX", "FBX"},
                                                           {"c.dae", "COLLADA"},
                                                           {"d.usdz", "USD"},
                                                           {"e.ifc", "IFC"},
                                                           {"f.3ds", "3DS"},
                                                           {"g.blend", "Blender"},
                                                           {"h.rad", "Radiance"},
                                                           {"i.dxf", "DXF"},
                                                           {"j.step", "STEP"},
                                                           {"k.STP", "STEP"},
                                                           {"l.ies", "IES"},
                                                           {"m.ldt", "EULUMDAT"},
                                                           {"n.skp", "SketchUp"},
                                                           {"o.dwg", "DWG"},
                                                           {"p.3mf", "3MF"},
                                                           {"q.idf", "EnergyPlus"},
                                                           {"r.wrl", "VRML"},
                                                           {"s.mtl", "material library"},
                                                           {"t.png", "picture"},
                                                           {"u.zip", "archive"},
                                                           {"v.3dm", "Rhino"},
                                                           {"w.vs3", "View3D"}};
    for (const auto& [name, format] : endings) expect_told(foreign_name(name), format, name);
    for (const char* name : {"a.json", "a.obj", "a", "", ".", "a.m", "a.plyx"})
        EXPECT_EQ(foreign_name(name), "") << name;
}

TEST(KnownFormats, AreToldByTheirContent) {
    const std::pair<const char*, const char*> contents[] = {
        {"ply\nformat ascii 1.0\n", "PLY"},
        {"Kaydara FBX Binary  ", "FBX"},
        {"; FBX 7.3.0 project file", "FBX"},
        {"<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"\">", "COLLADA"},
        {"#usda 1.0\n", "USD"},
        {"PXR-USDC", "USD"},
        {"BLENDER-v300", "Blender"},
        {"ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('IFC4'));", "IFC"},
        {"ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('AP214'));", "STEP"},
        {"  0\nSECTION\n  2\nHEADER\n", "DXF"},
        {"IESNA:LM-63-2002\n", "IES"},
        {"# a room\nvoid plastic white\n0\n0\n5 .5 .5 .5 0 0\n", "Radiance"},
        {"#?RADIANCE\n", "picture"},
        {"\x89PNG\r\n", "picture"},
        {"PK\x03\x04", "archive"},
        {"OFF\n8 6 12\n", "OFF"},
        {"#VRML V2.0 utf8\n", "VRML"},
        {"<?xml?><Project/>", "XML"},
        {"glTF\x02", ".glb"},
        {"solid a\nfacet normal 0 0 1\n", ".stl"},
        {"# made by hand\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", ".obj"},
        {"newmtl a\nKd 1 1 1\n", "material library"}};
    for (const auto& [bytes, format] : contents) expect_told(foreign_content(bytes), format, bytes);
    for (const char* bytes : {"", "{", "{\"version\": 1}", "hello", "x\n", "\n\n", "0"})
        EXPECT_EQ(foreign_content(bytes), "") << bytes;
}

TEST(KnownFormats, AreNamedWhereAFileIsTakenForAScene) {
    write_test_file("a.ply", "x\n");
    write_test_file("ply.json", "ply\nformat ascii 1.0\n");
    write_test_file("b.stl", "ply\nformat ascii 1.0\n");
    for (const char* name : {"a.ply", "ply.json", "b.stl"}) {
        const Outcome outcome = run_program(std::string("check ") + name);
        EXPECT_EQ(outcome.code, 2);
        EXPECT_NE(outcome.err.find(std::string(name) + ": is a PLY mesh, which is not read; "),
                  std::string::npos)
            << outcome.err;
    }
    expect_file_rejected("c.ply", "x\n", "is a PLY mesh");
    expect_file_rejected("c.bin2", "solid a\nfacet\n", ".stl");
}

TEST(KnownFormats, JsonOfOtherProgramsIsToldApart) {
    expect_rejected(R"({"asset": {"version": "2.0"}, "nodes": []})", "", "glTF");
    expect_rejected(R"({"type": "CityJSON", "version": "2.0"})", "", "CityJSON");
    expect_rejected(R"({"type": "Model", "rooms": []})", "", "Honeybee");
    expect_rejected("ply\n", "", "PLY");
    expect_rejected("{ply", "", "");
}

}  // namespace
}  // namespace patchlight::server::known_formats_test
