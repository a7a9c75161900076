// exemplar: give it one example; get as much more of it as you want.
// Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT

#include "synth/model/examples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/random.h"

namespace exemplar::test {
namespace {

/// A grid whose cells are named; each name becomes a label when it first appears.
class Sketch {
 public:
  explicit Sketch(const Vec3i& size) { grid_.cells = Array3D<Label>(size, 0), name("."); }

  void set(int x, int y, int z, const std::string& what) { grid_.cells(x, y, z) = name(what); }
  bool empty(int x, int y, int z) const { return grid_.cells(x, y, z) == 0; }
  bool contains(int x, int y, int z) const { return grid_.cells.contains({x, y, z}); }
  std::string at(int x, int y, int z) const { return grid_.labels[grid_.cells(x, y, z)].name; }
  LabelGrid grid() const { return grid_; }

  /// Writes an object layer by layer; each cell's name is its character after `prefix`, '.' leaves
  /// what is there.
  void stamp(const Vec3i& at, const std::string& prefix,
             const std::vector<std::vector<std::string>>& layers) {
    for (int k = 0; k < static_cast<int>(layers.size()); ++k) {
      for (int j = 0; j < static_cast<int>(layers[k].size()); ++j) {
        for (int i = 0; i < static_cast<int>(layers[k][j].size()); ++i) {
          const char c = layers[k][j][i];
          if (c != '.') set(at.x + i, at.y + j, at.z + k, prefix + c);
        }
      }
    }
  }

 private:
  Label name(const std::string& what) {
    const auto [found, fresh] = labels_.try_emplace(what, static_cast<Label>(labels_.size()));
    if (fresh) {
      grid_.labels.emplace_back();
      grid_.labels.back().name = what;
    }
    return found->second;
  }

  LabelGrid grid_;
  std::map<std::string, Label> labels_;
};

}  // namespace

LabelGrid drawn(const std::vector<std::vector<std::string>>& layers) {
  Sketch s({static_cast<int>(layers[0][0].size()), static_cast<int>(layers[0].size()),
            static_cast<int>(layers.size())});
  s.stamp({0, 0, 0}, "", layers);
  return s.grid();
}

LabelGrid drawnFlat(const std::vector<std::string>& rows) {
  return drawn({{rows.rbegin(), rows.rend()}});
}

LabelGrid figure35(bool infallible) {
  // Turned by the diagonal, since cells are filled column by column here and row by row there: the
  // '6' is two cells above its '2', and what joins them lies to the right.
  const std::string between = infallible ? "9" : ".", inside = infallible ? "i" : ".";
  return drawnFlat({
      "...............",
      ".65....6cb.....",
      "." + between + "4...." + between + inside + "h.....",
      ".23....278...1.",
      "...............",
      "....111........",
      "...............",
  });
}

LabelGrid figure36() {
  // Steps between cells are tried in a scattered order; each cell takes part in two at most.
  const int n = 26;
  const Random random(36);
  std::vector<std::array<int, 3>> steps;
  for (int i = 1; i < n - 1; ++i) {
    for (int j = 1; j < n - 1; ++j) {
      if (i < n - 2) steps.push_back({i, j, 0});
      if (j < n - 2) steps.push_back({i, j, 1});
    }
  }
  for (std::size_t i = steps.size(); i > 1; --i) {
    std::swap(steps[i - 1], steps[random.below(static_cast<std::uint32_t>(i), i)]);
  }
  steps.resize(steps.size() * 2 / 3);
  std::map<std::pair<int, int>, std::string> exits;
  for (const auto& [i, j, axis] : steps) {
    std::string& a = exits[{i, j}];
    std::string& b = exits[{i + 1 - axis, j + axis}];
    if (a.size() > 1 || b.size() > 1) continue;
    a += axis == 0 ? 'e' : 'n';
    b += axis == 0 ? 'w' : 's';
  }
  Sketch s({n, n, 1});
  for (auto& [p, e] : exits) {
    std::sort(e.begin(), e.end());
    if (!e.empty()) s.set(p.first, p.second, 0, e);
  }
  return s.grid();
}

LabelGrid canyon() {
  // A cell's label is which of its eight corners lie below the ground.
  const int n = 28, height = 10;
  const auto ground = [&](int x, int y) {
    const double u = 0.9 * x + 3 * std::sin(0.31 * y), v = 0.7 * y + 2 * std::cos(0.27 * x);
    const double h = 4.2 + 2.4 * std::sin(0.45 * u) * std::cos(0.38 * v) + 1.2 * std::sin(0.8 * v);
    return std::clamp(static_cast<int>(std::lround(h)), 1, height - 1);
  };
  Sketch s({n, n, height});
  for (int x = 0; x < n; ++x) {
    for (int y = 0; y < n; ++y) {
      for (int z = 0; z < height; ++z) {
        std::string corners;
        for (int c = 0; c < 8; ++c) {
          corners += ground(x + (c & 1), y + (c >> 1 & 1)) > z + (c >> 2) - 1 ? '1' : '0';
        }
        if (corners != "00000000") s.set(x, y, z, corners);
      }
    }
  }
  return s.grid();
}

LabelGrid city() {
  const int n = 30, height = 10;
  Sketch s({n, n, height});
  // Streets every ten cells, two wide, with walks beside them.
  const auto road = [](int i) { return i % 10 < 2; };
  const auto walk = [](int i) { return i % 10 == 2 || i % 10 == 9; };
  for (int x = 0; x < n; ++x) {
    for (int y = 0; y < n; ++y) {
      std::string what = "lawn";
      const std::string side = std::to_string(x % 10) + std::to_string(y % 10);
      if (road(x) && road(y)) {
        what = "crossing" + side;
      } else if (road(x)) {
        what = "streetY" + std::to_string(x % 10) + (walk(y) ? "stop" : "");
      } else if (road(y)) {
        what = "streetX" + std::to_string(y % 10) + (walk(x) ? "stop" : "");
      } else if (walk(x) && walk(y)) {
        what = "corner" + side;
      } else if (walk(x)) {
        what = "walkY" + std::to_string(x % 10);
      } else if (walk(y)) {
        what = "walkX" + std::to_string(y % 10);
      }
      s.set(x, y, 0, what);
      if (walk(x) && !walk(y) && !road(y) && (y % 10) % 3 == 0) {
        s.set(x, y, 1, "post");
        s.set(x, y, 2, "lamp");
      }
      if (road(x) && !road(y) && !walk(y) && (x + 3 * y) % 7 == 0) {
        s.set(x, y, 1, "car" + std::to_string((x + y) % 3));
      }
    }
  }
  // Nine houses; walls by their place in the plan, floors by their height.
  const std::array<Vec3i, 9> houses{Vec3i{4, 4, 5}, {5, 4, 7}, {4, 5, 3}, {5, 5, 8}, {4, 4, 6},
                                    {5, 4, 4},      {4, 4, 8}, {4, 5, 7}, {5, 5, 4}};
  for (int h = 0; h < 9; ++h) {
    const int x0 = 10 * (h % 3) + 3 + h % 2, y0 = 10 * (h / 3) + 3 + (h / 3) % 2;
    const Vec3i size = houses[h];
    const std::string style = h % 2 ? "brick" : "stone";
    for (int x = 0; x < size.x; ++x) {
      for (int y = 0; y < size.y; ++y) {
        const std::string place = std::string(x == 0            ? "w"
                                              : x == size.x - 1 ? "e"
                                                                : "") +
                                  (y == 0            ? "s"
                                   : y == size.y - 1 ? "n"
                                                     : "");
        for (int z = 0; z < size.z; ++z) {
          const bool door = z == 0 && place == "s" && x == 2;
          const std::string floor = z == 0            ? (door ? "door" : "ground")
                                    : z == size.z - 1 ? "roof"
                                    : place.empty()   ? "inside"
                                    : (z % 2)         ? "floor"
                                                      : "lit";
          s.set(x0 + x, y0 + y, z, style + floor + place);
        }
      }
    }
  }
  return s.grid();
}

LabelGrid gadgets() {
  Sketch s({20, 20, 10});
  const auto direction = [](const Vec3i& d) {
    return std::string(d.x ? "x" : d.y ? "y" : "z") + (d.x + d.y + d.z > 0 ? "+" : "-");
  };
  // A belt that runs round a rectangle in the plane of axes a and b; a cell is named by where the
  // belt comes from and where it goes.
  const auto belt = [&](const Vec3i& corner, int a, int b, int length, int width, bool reverse) {
    std::vector<Vec3i> cells;
    Vec3i p = corner;
    for (int side = 0; side < 4; ++side) {
      const int axis = side % 2 ? b : a;
      for (int i = 1; i < (side % 2 ? width : length); ++i) {
        cells.push_back(p);
        p[axis] += side < 2 ? 1 : -1;
      }
    }
    if (reverse) std::reverse(cells.begin(), cells.end());
    const int n = static_cast<int>(cells.size());
    for (int i = 0; i < n; ++i) {
      const Vec3i& c = cells[i];
      const std::string in = direction(c - cells[(i + n - 1) % n]);
      const std::string out = direction(cells[(i + 1) % n] - c);
      s.set(c.x, c.y, c.z, in == out ? in : in + out);
    }
  };
  belt({1, 2, 1}, 0, 2, 5, 4, false);
  belt({1, 4, 1}, 0, 2, 4, 5, true);
  belt({8, 1, 1}, 1, 2, 5, 4, false);
  belt({10, 1, 1}, 1, 2, 4, 5, true);
  // Shafts from side to side, against each other in pairs where gears join them.
  for (int i = 0; i < 20; ++i) {
    const std::string gear = i % 7 == 4 ? "gear" : "";
    s.set(i, 9, 7, "x+" + gear);
    s.set(i, 9, 8, "x-" + gear);
    s.set(15, i, 5, "y+" + gear);
    s.set(16, i, 5, "y-" + gear);
  }
  return s.grid();
}

LabelGrid parliament() {
  Sketch s({34, 30, 10});
  const Vec3i size{34, 30, 10};
  for (int x = 0; x < size.x; ++x) {
    for (int y = 0; y < size.y; ++y) s.set(x, y, 0, "ground");
  }
  // A wing along x or y: two cells deep, windows and buttresses by turns, a pitched roof.
  const auto wingX = [&](int x0, int x1, int y, int floors) {
    for (int x = x0; x <= x1; ++x) {
      const std::string bay = (x - x0) % 2 ? "b" : "w";
      for (int z = 1; z <= floors; ++z) {
        const std::string level = z == 1 ? "g" : z == floors ? "t" : "m";
        s.set(x, y, z, "wxF" + level + bay);
        s.set(x, y + 1, z, "wxB" + level + bay);
      }
      s.set(x, y, floors + 1, "wxrF" + bay);
      s.set(x, y + 1, floors + 1, "wxrB" + bay);
    }
  };
  const auto wingY = [&](int y0, int y1, int x, int floors) {
    for (int y = y0; y <= y1; ++y) {
      const std::string bay = (y - y0) % 2 ? "b" : "w";
      for (int z = 1; z <= floors; ++z) {
        const std::string level = z == 1 ? "g" : z == floors ? "t" : "m";
        s.set(x, y, z, "wyL" + level + bay);
        s.set(x + 1, y, z, "wyR" + level + bay);
      }
      s.set(x, y, floors + 1, "wyrL" + bay);
      s.set(x + 1, y, floors + 1, "wyrR" + bay);
    }
  };
  // A tower: two by two cells, higher than the wings, with a spire.
  const auto tower = [&](int x, int y, int floors) {
    const std::array<const char*, 4> part{"a", "b", "c", "d"};
    for (int p = 0; p < 4; ++p) {
      const int i = x + p % 2, j = y + p / 2;
      for (int z = 1; z <= floors; ++z) {
        s.set(i, j, z, std::string("tw") + part[p] + (z == 1 ? "g" : z == floors ? "t" : "m"));
      }
      s.set(i, j, floors + 1, std::string("sp") + part[p]);
    }
  };
  // A dome of four by four cells on a drum.
  const auto dome = [&](int x, int y) {
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) {
        const std::string place = std::to_string(i) + std::to_string(j);
        const bool edge = i == 0 || j == 0 || i == 3 || j == 3;
        for (int z = 1; z <= 3; ++z) {
          if (edge) {
            s.set(x + i, y + j, z, (z == 3 ? "dt" : z == 2 ? "dm" : "dg") + place);
          } else {
            s.set(x + i, y + j, z, "hall");
          }
        }
        s.set(x + i, y + j, 4, "cupola" + place);
      }
    }
  };
  tower(3, 3, 6);
  wingX(5, 11, 3, 3);
  tower(12, 3, 7);
  wingX(14, 18, 3, 3);
  tower(19, 3, 6);
  wingY(5, 11, 3, 3);
  tower(3, 12, 5);
  wingY(5, 9, 12, 3);
  dome(11, 10);
  wingX(15, 19, 11, 3);
  tower(20, 11, 6);
  wingY(13, 17, 20, 3);
  tower(20, 18, 7);
  tower(8, 20, 6);
  wingX(10, 16, 20, 4);
  tower(17, 20, 6);
  dome(26, 22);
  wingX(21, 25, 23, 3);
  tower(19, 23, 6);
  return s.grid();
}

LabelGrid escheresque() {
  Sketch s({24, 24, 10});
  for (int x = 0; x < 24; ++x) {
    for (int y = 0; y < 24; ++y) s.set(x, y, 0, "ground");
  }
  // A closed path walked cell by cell; '+' climbs a step, '-' goes down one. Under it stands a
  // pillar on every third cell, arches between.
  const auto path = [&](int x, int y, int z, const std::string& walk) {
    static const std::map<char, std::array<int, 2>> step{
        {'E', {1, 0}}, {'N', {0, 1}}, {'W', {-1, 0}}, {'S', {0, -1}}};
    std::string heading;  // without the slopes
    for (const char c : walk) {
      if (step.contains(c)) heading += c;
    }
    int at = 0, slope = 0;
    const int count = static_cast<int>(heading.size());
    for (const char c : walk) {
      if (c == '+' || c == '-') {
        slope = c == '+' ? 1 : -1;
        continue;
      }
      const char before = heading[(at + count - 1) % count];
      std::string name = "path";
      if (slope != 0) {
        // Stairs that rise towards the heading, or away from it.
        static const std::map<char, char> back{{'E', 'W'}, {'W', 'E'}, {'N', 'S'}, {'S', 'N'}};
        const char up = slope > 0 ? c : back.at(c);
        if (slope < 0) --z;
        name = std::string("stairs") + up;
      } else if (before == c) {
        name += c == 'E' || c == 'W' ? "X" : "Y";
      } else {
        const auto exits = [](char a, char b) {
          static const std::map<char, char> back{{'E', 'W'}, {'W', 'E'}, {'N', 'S'}, {'S', 'N'}};
          std::string e{back.at(a), b};
          std::sort(e.begin(), e.end());
          return e;
        };
        name += exits(before, c);
      }
      const bool turn = name.size() == 6, stairs = name[0] == 's';
      const bool pillar = turn || stairs || (x + y) % 3 == 0;
      s.set(x, y, z, name + (pillar ? "P" : "A"));
      if (pillar) {
        for (int k = z - 1; k > 0 && s.empty(x, y, k); --k) {
          s.set(x, y, k, k == z - 1 ? "capital" : k == 1 ? "base" : "pillar");
        }
      } else if (z > 1 && s.empty(x, y, z - 1)) {
        s.set(x, y, z - 1, name == "pathX" ? "archX" : "archY");
      }
      if (slope > 0) ++z;
      slope = 0;
      ++at;
      x += step.at(c)[0];
      y += step.at(c)[1];
    }
  };
  path(3, 3, 3,
       "EEEEEE"
       "NNNNN"
       "WWWWWW"
       "SSSSS");
  path(12, 3, 3,
       "EE+EEE"
       "EE"
       "NNNNNN"
       "WW-WWW"
       "WW"
       "SSSSSS");
  path(3, 12, 3,
       "EEE"
       "NN+NNN"
       "EEE+EEE"
       "NNN"
       "WWW-WWW"
       "WW-W"
       "SSSSSSSS");
  path(14, 13, 5,
       "EEE-EEE"
       "NNN+NN"
       "NN"
       "WWWWWW"
       "SSSSSSS");
  return s.grid();
}

}  // namespace exemplar::test
