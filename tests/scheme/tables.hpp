#pragma once

#include "folder.hpp"
#include "scheme/families.hpp"
#include "scheme/met_orders.hpp"

namespace hbvm::core {

/// The scheme that a text is.
inline SchemePtr scheme_of(const std::string& text, const std::string& kind = "toml") {
  const Folder folder;
  return make_scheme(read_scheme_text(folder.write("scheme." + kind, text)));
}

/// What its conditions say, with 120 digits or more.
inline std::vector<MetPart> parts_of(const Scheme& scheme, std::optional<int> digits = {}) {
  const Rounding rounding = Rounding::of(scheme, digits);
  const PrecisionScope scope(rounding.working_digits);
  return met_parts(scheme, scheme.written_values<Mpfr>(), rounding);
}
inline int order_of(const std::string& text, std::size_t part = 0) { return parts_of(*scheme_of(text)).at(part).order; }

inline const std::string fehlberg =
    "A = [[0,0,0,0,0,0], ['1/4',0,0,0,0,0], ['3/32','9/32',0,0,0,0], ['1932/2197','-7200/2197','7296/2197',0,0,0],\n"
    "['439/216',-8,'3680/513','-845/4104',0,0], ['-8/27',2,'-3544/2565','1859/4104','-11/40',0]]\n"
    "b = ['16/135',0,'6656/12825','28561/56430','-9/50','2/55']\n"
    "b_hat = ['25/216',0,'1408/2565','2197/4104','-1/5',0]\n"
    "c = [0,'1/4','3/8','12/13',1,'1/2']\n";

inline const std::string forest_ruth =
    "family = 'splitting'\n"
    "a = ['1/(2*(2-2^(1/3)))', '(1-2^(1/3))/(2*(2-2^(1/3)))', '(1-2^(1/3))/(2*(2-2^(1/3)))', '1/(2*(2-2^(1/3)))']\n"
    "b = ['1/(2-2^(1/3))', '-2^(1/3)/(2-2^(1/3))', '1/(2-2^(1/3))']\n";

/// Yoshida's solution A of order 6, with its 15 digits.
inline const std::string yoshida_6 =
    "gamma = [0.784513610477560, 0.235573213359357, -1.17767998417887, '1-2*(0.784513610477560+0.235573213359357"
    "-1.17767998417887)', -1.17767998417887, 0.235573213359357, 0.784513610477560]\n";

inline const std::string nystrom_4 =
    "family = 'nystrom'\nc = [0, '1/2', 1]\nA = [[0,0,0], ['1/8',0,0], [0,'1/2',0]]\n"
    "b = ['1/6','1/3',0]\nb_hat = ['1/6','2/3','1/6']\n";

inline const std::string lobatto_pair =
    "A = [[0,0,0], ['5/24','1/3','-1/24'], ['1/6','2/3','1/6']]\nb = ['1/6','2/3','1/6']\n"
    "A_hat = [['1/6','-1/6',0], ['1/6','1/3',0], ['1/6','5/6',0]]\nb_hat = ['1/6','2/3','1/6']\n";

inline const std::string calahan =
    "alpha = [[0,0],['2/3',0]]\ngamma = [['(3+sqrt(3))/6',0],['-4/3*(3+sqrt(3))/6','(3+sqrt(3))/6']]\nb = "
    "['1/4','3/4']\n";

}  // namespace hbvm::core
