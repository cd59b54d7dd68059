// The scene of the renderer: meshes in its own vertex format, and objects that move.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

using Vec3 = std::array<float, 3>;

// A matrix as an array of columns, as in shaders.
using Mat4 = std::array<std::array<float, 4>, 4>;

inline Mat4 operator*(const Mat4 &a, const Mat4 &b) {
    Mat4 product{};
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            for (int i = 0; i < 4; ++i) product[column][row] += a[i][row] * b[column][i];
    return product;
}

inline float dot(Vec3 a, Vec3 b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline Vec3 cross(Vec3 a, Vec3 b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Vec3 normalized(Vec3 v) {
    const float length = std::sqrt(dot(v, v));
    return {v[0] / length, v[1] / length, v[2] / length};
}

// The matrix that scales along the three axes, turns around the x axis and then around the y axis, and moves to a place.
inline Mat4 placed(Vec3 at, float around_x, float around_y, Vec3 scale) {
    const float cx = std::cos(around_x), sx = std::sin(around_x), cy = std::cos(around_y), sy = std::sin(around_y);
    return {{{scale[0] * cy, 0, -scale[0] * sy, 0},
             {scale[1] * sy * sx, scale[1] * cx, scale[1] * cy * sx, 0},
             {scale[2] * sy * cx, -scale[2] * sx, scale[2] * cy * cx, 0},
             {at[0], at[1], at[2], 1}}};
}

inline Mat4 looking(Vec3 from, Vec3 at) {
    const Vec3 back = normalized({from[0] - at[0], from[1] - at[1], from[2] - at[2]});
    const Vec3 right = normalized(cross({0, 1, 0}, back)), up = cross(back, right);
    return {{{right[0], up[0], back[0], 0},
             {right[1], up[1], back[1], 0},
             {right[2], up[2], back[2], 0},
             {-dot(right, from), -dot(up, from), -dot(back, from), 1}}};
}

// A perspective projection with Vulkan's conventions: y down, depth from 0 (near) to 1 (far).
inline Mat4 perspective(float height_angle, float aspect, float near, float far) {
    const float f = 1 / std::tan(0.5f * height_angle);
    return {{{f / aspect, 0, 0, 0}, {0, -f, 0, 0}, {0, 0, far / (near - far), -1}, {0, 0, near * far / (near - far), 0}}};
}

// A vertex of 16 bytes.
struct Vertex {
    float position[3];
    int8_t normal[4];
};

// An object, laid out as in shaders/host.glsl.
struct Object {
    Mat4 to_clip, to_world;
    float color[4];
};

struct Mesh {
    uint32_t first_vertex, vertex_count, first_index, triangle_count;
};

enum Key : uint32_t { CHECKERS, GLOSS, KEYS };

// A part of the scene: its mesh, material and colour.
struct Part {
    Mesh mesh;
    Key key;
    Vec3 color;
};

struct World {
    std::vector<Vertex> vertices;
    std::vector<uint16_t> indices;
    std::vector<Part> parts;
    // Totals of all parts.
    uint32_t vertex_count = 0, triangle_count = 0;

    World() {
        const Mesh floor = grid(1, 1, [](float u, float v) {
            return std::array<Vec3, 2>{{{2 * u - 1, 0, 2 * v - 1}, {0, 1, 0}}};
        });
        const Mesh ball = grid(48, 24, [](float u, float v) {
            const float around = 6.2831853f * u, down = 3.1415927f * v;
            const Vec3 out{std::sin(down) * std::sin(around), std::cos(down), std::sin(down) * std::cos(around)};
            return std::array<Vec3, 2>{{out, out}};
        });
        const Mesh rod = grid(6, 1, [](float u, float v) {
            const float around = 6.2831853f * u;
            const Vec3 out{std::sin(around), 0, std::cos(around)};
            return std::array<Vec3, 2>{{{out[0], 1 - 2 * v, out[2]}, out}};
        });
        add({floor, CHECKERS, {0.8f, 0.75f, 0.65f}});
        const Vec3 colors[] = {{0.75f, 0.12f, 0.08f}, {0.1f, 0.35f, 0.15f}, {0.08f, 0.2f, 0.6f}};
        for (const Vec3 &color : colors) add({ball, GLOSS, color});
        for (int i = 0; i < RODS; ++i) add({rod, GLOSS, {0.9f, 0.6f, 0.15f}});
    }

    // The objects of all parts at a time in seconds.
    std::vector<Object> objects(float time, const Mat4 &to_clip) const {
        std::vector<Object> objects;
        for (uint32_t number = 0; number < parts.size(); ++number) {
            const Part &part = parts[number];
            Object object{};
            object.to_world = place(number, time);
            object.to_clip = to_clip * object.to_world;
            for (int i = 0; i < 3; ++i) object.color[i] = part.color[i];
            objects.push_back(object);
        }
        return objects;
    }

  private:
    static constexpr int BALLS = 3, RODS = 16;

    static Mat4 place(uint32_t number, float time) {
        if (number == 0) return placed({0, 0, 0}, 0, 0, {7, 1, 7});
        const float i = float(number - 1);
        if (number <= BALLS)
            return placed({1.7f * (i - 1), 0.7f + 0.2f * std::sin(time + 2 * i), 0.3f * i - 1}, 0, time, {0.6f, 0.6f, 0.6f});
        const float along = i - BALLS - 0.5f * (RODS - 1);
        return placed({0.32f * along, 0.8f, 0.9f}, 0.5f + 0.06f * along + 0.2f * time, 0.4f * along, {0.012f, 0.9f, 0.012f});
    }

    void add(const Part &part) {
        parts.push_back(part);
        vertex_count += part.mesh.vertex_count;
        triangle_count += part.mesh.triangle_count;
    }

    // Adds a mesh over a grid; `at` gives position and normal for u and v from 0 to 1. Front faces are on the side of the normal.
    template <typename F> Mesh grid(uint32_t columns, uint32_t rows, F at) {
        Mesh mesh{uint32_t(vertices.size()), (columns + 1) * (rows + 1), uint32_t(indices.size()), 2 * columns * rows};
        for (uint32_t row = 0; row <= rows; ++row) {
            for (uint32_t column = 0; column <= columns; ++column) {
                const auto [position, normal] = at(float(column) / float(columns), float(row) / float(rows));
                Vertex vertex{};
                for (int i = 0; i < 3; ++i) {
                    vertex.position[i] = position[i];
                    vertex.normal[i] = int8_t(std::lround(127 * normal[i]));
                }
                vertices.push_back(vertex);
            }
        }
        for (uint32_t row = 0; row < rows; ++row) {
            for (uint32_t column = 0; column < columns; ++column) {
                const uint32_t a = row * (columns + 1) + column, b = a + 1, c = a + columns + 1, d = c + 1;
                for (uint32_t index : {a, d, b, a, c, d}) indices.push_back(uint16_t(index));
            }
        }
        return mesh;
    }
};
