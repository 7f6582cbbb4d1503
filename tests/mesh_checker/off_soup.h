// Triangles of .off files.
#pragma once

#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

template <class Point>
struct Soup {
  std::vector<Point> points;
  std::vector<std::vector<size_t>> triangles;
};

template <class Point>
Soup<Point> read_off(const std::string& path) {
  std::ifstream file(path);
  std::string word;
  size_t vertices = 0, faces = 0, edges = 0;
  file >> word >> std::ws;
  while (file.peek() == '#') std::getline(file, word), file >> std::ws;
  file >> vertices >> faces >> edges;
  Soup<Point> soup;
  for (size_t n = 0; n < vertices; ++n) {
    double x = 0, y = 0, z = 0;
    file >> x >> y >> z;
    soup.points.emplace_back(x, y, z);
  }
  for (size_t n = 0; n < faces; ++n) {
    size_t corners = 0;
    file >> corners;
    std::vector<size_t> face(corners);
    for (size_t& corner : face) file >> corner;
    if (!file) throw std::runtime_error(path + " is no OFF file");
    std::getline(file, word);  // colours
    soup.triangles.push_back(std::move(face));
  }
  if (soup.triangles.empty()) throw std::runtime_error(path + " holds no triangles");
  return soup;
}
