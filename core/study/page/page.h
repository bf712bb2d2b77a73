// A study's results as a page that stands by itself, but for its pictures.
#pragma once

#include <string>

#include "study/study.h"
#include "study/table.h"

namespace voxtet {

/// HTML. What became of the cases in words, failures with their reasons, distributions, figures against each
/// other and against the forecast, outliers with their pictures (pictures/KEY.png beside the page), and the
/// whole table. Each case is a link: `base`, an address of the app, and the link of the case.
std::string study_page(const Study& study, const StudyTable& table, const std::string& base);

}  // namespace voxtet
