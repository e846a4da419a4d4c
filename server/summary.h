#pragma once

#include "server/job.h"
#include "server/run_job.h"

#include <string>
#include <vector>

namespace patchlight::server {

/// About eight lines for people.
std::string summary(const Job& job, const JobResult& result);

/// "findings: …", a line each, or "findings: none".
std::string finding_lines(const std::vector<Finding>& findings);

/// Such as "1.3 GB".
std::string memory_text(double bytes);

/// Three significant digits.
std::string rounded(double number);

}  // namespace patchlight::server
