#include "server/import_remarks.h"

#include <gtest/gtest.h>

namespace patchlight::server::import_remarks_test {
namespace {

TEST(ImportRemarks, OneFindingOfEachKindNamesAllMaterials) {
    ImportRemarks remarks;
    for (const char* name : {"a", "b"}) {
        FileMaterial material;
        material.name = name;
        material.reflectance = Rgb(1.0, 0.5, 0.5);
        remarks.look_at(material, {false, "'wood.png' is missing"});
    }
    const auto findings = remarks.findings("thing", "thing.obj");
    ASSERT_EQ(findings.size(), 2u);
    EXPECT_EQ(findings[0].kind, "reflectance-clamped");
    EXPECT_EQ(findings[1].kind, "texture-ignored");
    for (const Finding& finding : findings) {
        EXPECT_EQ(finding.objects, std::vector<std::string>{"thing"});
        EXPECT_NE(finding.detail.find(": 'a', 'b'"), std::string::npos) << finding.detail;
    }
}

TEST(ImportRemarks, OfManyMaterialsTheFirstTenAreNamed) {
    ImportRemarks remarks;
    for (int k = 0; k < 25; ++k) {
        FileMaterial material;
        material.name = "m" + std::to_string(k);
        remarks.look_at(material);
    }
    const auto findings = remarks.findings("thing", "thing.obj");
    ASSERT_EQ(findings.size(), 1u);
    EXPECT_TRUE(findings[0].detail.ends_with("'m9' and 15 more")) << findings[0].detail;
}

TEST(ImportRemarks, AMaterialThatIsFineIsNotRemarkedOn) {
    ImportRemarks remarks;
    FileMaterial material;
    material.name = "fine";
    material.reflectance = Rgb::Constant(0.5);
    remarks.look_at(material);
    EXPECT_TRUE(remarks.findings("thing", "thing.obj").empty());
}

}  // namespace
}  // namespace patchlight::server::import_remarks_test
