// A forward renderer in C++ with its own vertex format, shaders and materials, antialiased through gpc.h.
//
//     make install PREFIX=$PWD/out/gpc
//     export PKG_CONFIG_PATH=out/gpc/lib/pkgconfig LD_LIBRARY_PATH=out/gpc/lib
//     c++ -std=c++17 -O2 examples/forward/forward.cpp -o out/forward $(pkg-config --cflags --libs gpc vulkan)
//     out/forward examples/forward/shaders/spirv out/forward.ppm
//
// For the library, the renderer got an attachment of triangle IDs, a vertex shader that computes positions by the library's
// function, a compute shader that shades the library's samples, and the code that is marked by `gpc` below. Frames are drawn into
// a ring of three images, as in a swapchain, then into larger ones. At the end, the picture is compared with the renderer's own
// brute force.
//
// With --sizes, the program measures pictures of these sizes instead, and prints a table in CSV.

#include "device.hpp"
#include "world.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <memory>

namespace {

constexpr VkExtent2D SIZE{240, 135};
// Samples along a pixel's side: BRUTE for brute force with as many samples as the library takes.
constexpr uint32_t BRUTE = 8, REFERENCE = 32;
// Largest number of pixels of an image for brute force. Larger pictures are drawn in parts.
constexpr uint64_t MOST_PIXELS = 1 << 26;
// Timed frames of each way to draw a picture.
constexpr size_t TIMED = 7;
// Number of colour images that antialiased frames are drawn into by turns, as in a swapchain.
constexpr size_t RING = 3;
constexpr VkFormat COLOR = VK_FORMAT_R8G8B8A8_SRGB, IDS = VK_FORMAT_R32_UINT, DEPTH = VK_FORMAT_D32_SFLOAT_S8_UINT;
constexpr VkImageAspectFlags DEPTH_STENCIL = VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;
// The background, in linear light.
constexpr float SKY[3] = {0.25f, 0.45f, 0.75f};
constexpr float EYE[3] = {0.4f, 1.5f, 4.2f};

// Push constants, as in shaders/host.glsl.
struct Push {
    float eye[4];
    uint32_t object, first_triangle;
};

constexpr GpcImageState UNDEFINED{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_NONE};
constexpr GpcImageState COLOR_DRAWN{VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                    VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                                    VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
constexpr GpcImageState DEPTH_DRAWN{VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
                                    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
                                    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
                                        VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
constexpr GpcImageState COPIED{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_2_COPY_BIT,
                               VK_ACCESS_2_TRANSFER_READ_BIT};

class Pipelines {
  public:
    const Device &device;
    VkDescriptorSetLayout set_layout{};
    // The layout of the renderer's own passes has its set. The layout for shading samples has gpc's set, and the renderer's.
    VkPipelineLayout layout{}, samples_layout{};
    VkPipeline forward[KEYS]{}, samples[KEYS]{};

    Pipelines(const Device &device, const std::string &folder, VkDescriptorSetLayout gpc) : device(device), folder(folder) {
        VkDescriptorSetLayoutBinding bindings[2]{};
        for (uint32_t i = 0; i < 2; ++i)
            bindings[i] = {i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_ALL, nullptr};
        VkDescriptorSetLayoutCreateInfo info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
        info.bindingCount = 2;
        info.pBindings = bindings;
        check(vkCreateDescriptorSetLayout(device.raw, &info, nullptr, &set_layout), "vkCreateDescriptorSetLayout");
        layout = make_layout({set_layout});
        samples_layout = make_layout({gpc, set_layout});
        for (uint32_t key = 0; key < KEYS; ++key) {
            forward[key] = make_forward(key);
            samples[key] = make_compute("samples", samples_layout, key);
        }
    }

    Pipelines(const Pipelines &) = delete;

    ~Pipelines() {
        for (VkPipeline pipeline : forward) vkDestroyPipeline(device.raw, pipeline, nullptr);
        for (VkPipeline pipeline : samples) vkDestroyPipeline(device.raw, pipeline, nullptr);
        vkDestroyPipelineLayout(device.raw, layout, nullptr);
        vkDestroyPipelineLayout(device.raw, samples_layout, nullptr);
        vkDestroyDescriptorSetLayout(device.raw, set_layout, nullptr);
    }

  private:
    std::string folder;

    VkPipelineLayout make_layout(const std::vector<VkDescriptorSetLayout> &sets) const {
        const VkPushConstantRange push{VK_SHADER_STAGE_ALL, 0, sizeof(Push)};
        VkPipelineLayoutCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
        info.setLayoutCount = uint32_t(sets.size());
        info.pSetLayouts = sets.data();
        info.pushConstantRangeCount = 1;
        info.pPushConstantRanges = &push;
        VkPipelineLayout made;
        check(vkCreatePipelineLayout(device.raw, &info, nullptr, &made), "vkCreatePipelineLayout");
        return made;
    }

    VkShaderModule load(const std::string &name) const {
        const std::string path = folder + "/" + name + ".spv";
        std::ifstream file(path, std::ios::binary | std::ios::ate);
        if (!file) throw std::runtime_error(path + " can't be read");
        std::vector<uint32_t> words(size_t(file.tellg()) / 4);
        file.seekg(0).read(reinterpret_cast<char *>(words.data()), std::streamsize(4 * words.size()));
        // gpc: checks that the library supports the version of the includes that the shader of samples was compiled with.
        if (name == "samples") check(gpc_check_shader(words.data(), 4 * words.size()));
        VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
        info.codeSize = 4 * words.size();
        info.pCode = words.data();
        VkShaderModule module;
        check(vkCreateShaderModule(device.raw, &info, nullptr, &module), "vkCreateShaderModule");
        return module;
    }

    // A stage; its specialisation constant 0, if it has one, is the key.
    struct Stage {
        VkSpecializationMapEntry entry{0, 0, 4};
        uint32_t key;
        VkSpecializationInfo constants{1, &entry, 4, &key};
        VkPipelineShaderStageCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};

        Stage(VkShaderStageFlagBits stage, VkShaderModule module, uint32_t key) : key(key) {
            info.stage = stage;
            info.module = module;
            info.pName = "main";
            info.pSpecializationInfo = &constants;
        }

        Stage(const Stage &) = delete;
    };

    VkPipeline make_compute(const std::string &name, VkPipelineLayout layout, uint32_t key) const {
        const VkShaderModule module = load(name);
        const Stage stage(VK_SHADER_STAGE_COMPUTE_BIT, module, key);
        VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
        info.stage = stage.info;
        info.layout = layout;
        VkPipeline made;
        check(vkCreateComputePipelines(device.raw, VK_NULL_HANDLE, 1, &info, nullptr, &made), "vkCreateComputePipelines");
        vkDestroyShaderModule(device.raw, module, nullptr);
        return made;
    }

    VkPipeline make_forward(uint32_t key) const {
        const VkShaderModule modules[] = {load("forward_vertex"), load("forward_fragment")};
        const Stage vertex(VK_SHADER_STAGE_VERTEX_BIT, modules[0], key);
        const Stage fragment(VK_SHADER_STAGE_FRAGMENT_BIT, modules[1], key);
        const VkPipelineShaderStageCreateInfo stages[] = {vertex.info, fragment.info};
        const VkVertexInputBindingDescription binding{0, sizeof(Vertex), VK_VERTEX_INPUT_RATE_VERTEX};
        const VkVertexInputAttributeDescription attributes[] = {
            {0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, position)},
            {1, 0, VK_FORMAT_R8G8B8A8_SNORM, offsetof(Vertex, normal)},
        };
        VkPipelineVertexInputStateCreateInfo input{VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
        input.vertexBindingDescriptionCount = 1;
        input.pVertexBindingDescriptions = &binding;
        input.vertexAttributeDescriptionCount = 2;
        input.pVertexAttributeDescriptions = attributes;
        VkPipelineInputAssemblyStateCreateInfo assembly{VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
        assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
        VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
        viewport.viewportCount = viewport.scissorCount = 1;
        VkPipelineRasterizationStateCreateInfo raster{VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
        raster.cullMode = VK_CULL_MODE_BACK_BIT;
        raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
        raster.lineWidth = 1;
        VkPipelineMultisampleStateCreateInfo multisample{VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
        multisample.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
        VkPipelineDepthStencilStateCreateInfo depth{VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
        depth.depthTestEnable = depth.depthWriteEnable = VK_TRUE;
        depth.depthCompareOp = VK_COMPARE_OP_LESS;
        // gpc: the second attachment holds IDs.
        VkPipelineColorBlendAttachmentState blended[2]{};
        blended[0].colorWriteMask = blended[1].colorWriteMask = 0xf;
        VkPipelineColorBlendStateCreateInfo blend{VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
        blend.attachmentCount = 2;
        blend.pAttachments = blended;
        const VkDynamicState states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
        VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};
        dynamic.dynamicStateCount = 2;
        dynamic.pDynamicStates = states;
        const VkFormat formats[] = {COLOR, IDS};
        VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
        rendering.colorAttachmentCount = 2;
        rendering.pColorAttachmentFormats = formats;
        rendering.depthAttachmentFormat = DEPTH;
        VkGraphicsPipelineCreateInfo info{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering};
        info.stageCount = 2;
        info.pStages = stages;
        info.pVertexInputState = &input;
        info.pInputAssemblyState = &assembly;
        info.pViewportState = &viewport;
        info.pRasterizationState = &raster;
        info.pMultisampleState = &multisample;
        info.pDepthStencilState = &depth;
        info.pColorBlendState = &blend;
        info.pDynamicState = &dynamic;
        info.layout = layout;
        VkPipeline made;
        check(vkCreateGraphicsPipelines(device.raw, VK_NULL_HANDLE, 1, &info, nullptr, &made), "vkCreateGraphicsPipelines");
        for (VkShaderModule module : modules) vkDestroyShaderModule(device.raw, module, nullptr);
        return made;
    }
};

// Buffers that all renderers share.
struct Meshes {
    Buffer vertices, indices;

    Meshes(const Device &device, const World &world)
        : vertices(device, world.vertices, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT),
          indices(device, world.indices, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT) {}
};

// The images that a renderer draws into: a ring of colour images, as in a swapchain; IDs and depth; a buffer for reading back.
struct Targets {
    std::vector<std::unique_ptr<Image>> colors;
    Image ids, depth;
    Buffer read_back;

    Targets(const Device &device, VkExtent2D size, size_t ring)
        : ids(device, size, IDS, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT, VK_IMAGE_ASPECT_COLOR_BIT,
              VK_IMAGE_ASPECT_COLOR_BIT),
          depth(device, size, DEPTH, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT, DEPTH_STENCIL,
                VK_IMAGE_ASPECT_DEPTH_BIT),
          read_back(device, VkDeviceSize(4) * size.width * size.height, VK_BUFFER_USAGE_TRANSFER_DST_BIT) {
        const VkImageUsageFlags usage =
            VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        while (colors.size() < ring)
            colors.push_back(std::make_unique<Image>(device, size, COLOR, usage, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_ASPECT_COLOR_BIT));
    }
};

// A picture: three sRGB codes from 0 to 1 for each pixel.
using Picture = std::vector<double>;

double encoded(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double decoded(double code) {
    return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

// Milliseconds that something took: by the clock, and of all processors together.
struct Time {
    double wall{}, cpu{};
};

// Measures the time since it was made.
class Watch {
  public:
    Time read() const {
        const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
        return {wall.count(), 1e3 * double(std::clock() - cpu_start) / CLOCKS_PER_SEC};
    }

  private:
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    std::clock_t cpu_start = std::clock();
};

// A way to draw a picture.
struct Way {
    VkExtent2D size;
    // The picture is the mean of `side` x `side` pixels.
    uint32_t side = 1;
    // Without an antialiaser, the other members have no effect.
    const GpcAntialiaser *antialiaser = nullptr;
    uint32_t samples = BRUTE * BRUTE;
    GpcPattern pattern = GPC_PATTERN_LINES;
    GpcShading shading = GPC_SHADING_PART;

    // The picture is drawn in this number of parts along each axis.
    uint32_t parts() const {
        const uint64_t pixels = uint64_t(size.width) * size.height * side * side;
        uint32_t parts = 1;
        while (pixels / (parts * parts) > MOST_PIXELS || size.width % parts || size.height % parts) ++parts;
        return parts;
    }

    // The images of this way.
    VkExtent2D image() const {
        return {size.width * side / parts(), size.height * side / parts()};
    }
};

// A renderer, which draws into images of one size, with or without the library.
class Renderer {
  public:
    Renderer(const Device &device, const World &world, const Meshes &meshes, const Pipelines &pipelines, const Way &way)
        : device(device), world(world), meshes(meshes), pipelines(pipelines), way(way), size(way.image()),
          objects(device, world.parts.size() * sizeof(Object), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT),
          targets(std::make_unique<Targets>(device, size, way.antialiaser ? RING : 1)) {
        VkCommandBufferAllocateInfo commands_info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
        commands_info.commandPool = device.pool;
        commands_info.commandBufferCount = 1;
        check(vkAllocateCommandBuffers(device.raw, &commands_info, &commands), "vkAllocateCommandBuffers");
        const VkDescriptorPoolSize pool_size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2};
        VkDescriptorPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
        pool_info.maxSets = 1;
        pool_info.poolSizeCount = 1;
        pool_info.pPoolSizes = &pool_size;
        check(vkCreateDescriptorPool(device.raw, &pool_info, nullptr, &pool), "vkCreateDescriptorPool");
        VkDescriptorSetAllocateInfo set_info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
        set_info.descriptorPool = pool;
        set_info.descriptorSetCount = 1;
        set_info.pSetLayouts = &pipelines.set_layout;
        check(vkAllocateDescriptorSets(device.raw, &set_info, &set), "vkAllocateDescriptorSets");
        const VkDescriptorBufferInfo buffers[] = {{meshes.vertices.raw, 0, VK_WHOLE_SIZE},
                                                  {objects.raw, 0, VK_WHOLE_SIZE}};
        VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
        write.dstSet = set;
        write.descriptorCount = 2;
        write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        write.pBufferInfo = buffers;
        vkUpdateDescriptorSets(device.raw, 1, &write, 0, nullptr);
        if (way.antialiaser) prepare();
    }

    Renderer(const Renderer &) = delete;

    ~Renderer() {
        gpc_frame_destroy(frame);
        vkDestroyDescriptorPool(device.raw, pool, nullptr);
        vkFreeCommandBuffers(device.raw, device.pool, 1, &commands);
    }

    // gpc: replaces the images by images of another size. No commands may be in flight.
    void resize(VkExtent2D to) {
        targets = std::make_unique<Targets>(device, to, RING);
        way.size = size = to;
        check(gpc_frame_resize(frame, size.width, size.height));
    }

    // Bytes that the library takes for this renderer's frame, and how many of these all frames share.
    std::pair<uint64_t, uint64_t> memory() const {
        return {gpc_frame_memory_bytes(frame), gpc_frame_shared_memory_bytes(frame)};
    }

    // Draws the scene at a time into the next image of the ring, or a part of the scene: the one in this column and row. Waits
    // for it, and returns the time that it took.
    Time draw(float time, uint32_t column = 0, uint32_t row = 0) {
        const Watch watch;
        ++drawn;
        Mat4 projection = perspective(0.8f, float(SIZE.width) / float(SIZE.height), 0.1f, 100);
        const float parts = float(way.parts());
        for (auto &terms : projection) {
            // Clip space of the part is -1 to 1 along each axis.
            terms[0] = parts * terms[0] + (parts - 1 - 2 * float(column)) * terms[3];
            terms[1] = parts * terms[1] + (parts - 1 - 2 * float(row)) * terms[3];
        }
        const Mat4 camera = projection * looking({EYE[0], EYE[1], EYE[2]}, {0, 0.6f, 0});
        const std::vector<Object> shown = world.objects(time, camera);
        objects.write(shown);
        begin();
        record_forward();
        if (frame) record_antialiasing(shown, projection);
        else change(canvas(), COLOR_DRAWN, COPIED);
        execute();
        return watch.read();
    }

    // Statistics of the library's last frame.
    GpcOutcome outcome() const {
        GpcOutcome outcome;
        check(gpc_init_outcome(&outcome, sizeof outcome));
        check(gpc_frame_outcome(frame, &outcome));
        return outcome;
    }

    // Draws all parts of the picture, and returns the time that it took.
    Time draw_all(float time) {
        Time sum;
        for (uint32_t row = 0; row < way.parts(); ++row)
            for (uint32_t column = 0; column < way.parts(); ++column) {
                const Time part = draw(time, column, row);
                sum = {sum.wall + part.wall, sum.cpu + part.cpu};
            }
        return sum;
    }

    // The picture of the last image, in which it is drawn as a whole.
    Picture picture() {
        Picture picture(size_t(3) * way.size.width * way.size.height);
        read(picture, 0, 0);
        return picture;
    }

    // The picture of the scene at a time.
    Picture picture(float time) {
        Picture picture(size_t(3) * way.size.width * way.size.height);
        for (uint32_t row = 0; row < way.parts(); ++row)
            for (uint32_t column = 0; column < way.parts(); ++column) {
                draw(time, column, row);
                read(picture, column, row);
            }
        return picture;
    }

  private:
    const Device &device;
    const World &world;
    const Meshes &meshes;
    const Pipelines &pipelines;
    Way way;
    VkExtent2D size;
    Buffer objects;
    std::unique_ptr<Targets> targets;
    size_t drawn{};
    VkCommandBuffer commands{};
    VkDescriptorPool pool{};
    VkDescriptorSet set{};
    GpcFrame *frame{};

    // The current colour image.
    const Image &canvas() const {
        return *targets->colors[drawn % targets->colors.size()];
    }

    void begin() {
        VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
    }

    // Executes what was recorded, and waits for it.
    void execute() {
        check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
        VkSubmitInfo submitted{VK_STRUCTURE_TYPE_SUBMIT_INFO};
        submitted.commandBufferCount = 1;
        submitted.pCommandBuffers = &commands;
        check(vkQueueSubmit(device.queue, 1, &submitted, VK_NULL_HANDLE), "vkQueueSubmit");
        check(vkQueueWaitIdle(device.queue), "vkQueueWaitIdle");
    }

    // Reads the part of a picture that the last image shows; each pixel is the mean of `side` x `side` pixels in linear light.
    void read(Picture &picture, uint32_t column, uint32_t row) {
        begin();
        record_read_back();
        execute();
        double linear[256];
        for (int code = 0; code < 256; ++code) linear[code] = decoded(code / 255.0);
        const auto *bytes = static_cast<const uint8_t *>(targets->read_back.mapped);
        const uint32_t side = way.side, width = way.size.width / way.parts(), height = way.size.height / way.parts();
        for (uint32_t y = 0; y < height; ++y)
            for (uint32_t x = 0; x < width; ++x)
                for (uint32_t channel = 0; channel < 3; ++channel) {
                    double sum = 0;
                    for (uint32_t i = y * side; i < (y + 1) * side; ++i)
                        for (uint32_t k = x * side; k < (x + 1) * side; ++k)
                            sum += linear[bytes[4 * (size_t(i) * size.width + k) + channel]];
                    const size_t pixel = size_t(row * height + y) * way.size.width + column * width + x;
                    picture[3 * pixel + channel] = encoded(sum / (side * side));
                }
    }

    // gpc: makes the library's frame, with what it is lent in all frames.
    void prepare() {
        GpcGeometry geometry;
        check(gpc_init_geometry(&geometry, sizeof geometry));
        geometry.positions = meshes.vertices.raw;
        geometry.positions_offset = offsetof(Vertex, position);
        geometry.position_stride = sizeof(Vertex);
        geometry.position_space = GPC_POSITION_SPACE_OBJECT;
        geometry.position_capacity = world.vertex_count;
        geometry.vertex_capacity = uint32_t(world.vertices.size());
        geometry.indices = meshes.indices.raw;
        geometry.index_type = VK_INDEX_TYPE_UINT16;
        geometry.index_capacity = uint32_t(world.indices.size());
        geometry.triangle_capacity = world.triangle_count;
        geometry.draw_capacity = uint32_t(world.parts.size());
        geometry.keys = KEYS;
        GpcImageKinds kinds;
        check(gpc_init_image_kinds(&kinds, sizeof kinds));
        kinds.ids = kinds.depth = VK_TRUE;
        kinds.color_format = COLOR;
        GpcOptions options;
        check(gpc_init_options(&options, sizeof options));
        options.width = size.width;
        options.height = size.height;
        options.samples = way.samples;
        options.pattern = way.pattern;
        options.shading = way.shading;
        // If all samples are shaded, even low contrasts are sampled.
        if (way.shading == GPC_SHADING_SAMPLE) options.contrast = 2;
        check(gpc_frame_create(way.antialiaser, &geometry, &kinds, &options, &frame));
    }

    // gpc: records antialiasing. The draws of the frame are listed in the order of their IDs.
    void record_antialiasing(const std::vector<Object> &shown, const Mat4 &projection) {
        std::vector<GpcDraw> draws;
        for (const Part &part : world.parts) {
            GpcDraw draw{};
            draw.first_index = part.mesh.first_index;
            draw.triangle_count = part.mesh.triangle_count;
            draw.vertex_offset = int32_t(part.mesh.first_vertex);
            draw.vertex_count = part.mesh.vertex_count;
            std::memcpy(draw.to_clip, shown[draws.size()].to_clip.data(), sizeof draw.to_clip);
            draw.key = part.key;
            draw.material = uint32_t(draws.size());
            draw.detailed = VK_TRUE;
            draws.push_back(draw);
        }
        GpcScenery scenery;
        check(gpc_init_scenery(&scenery, sizeof scenery));
        scenery.draw_count = uint32_t(draws.size());
        scenery.draw_stride = sizeof(GpcDraw);
        scenery.draws = draws.data();
        std::memcpy(scenery.projection, projection.data(), sizeof scenery.projection);
        scenery.viewport[2] = float(size.width);
        scenery.viewport[3] = float(size.height);
        GpcImages images;
        check(gpc_init_images(&images, sizeof images));
        const Image &ids = targets->ids, &depth = targets->depth, &color = canvas();
        images.ids = {ids.raw, ids.view, ids.aspects, COLOR_DRAWN, COLOR_DRAWN};
        images.depth = {depth.raw, depth.view, depth.aspects, DEPTH_DRAWN, DEPTH_DRAWN};
        images.color = {color.raw, color.view, color.aspects, COLOR_DRAWN, COPIED};
        const auto shade = [](void *user, VkCommandBuffer, const GpcVisibilitySamples *samples) noexcept {
            static_cast<const Renderer *>(user)->record_samples(*samples);
        };
        check(gpc_frame_record(frame, commands, &images, &scenery, shade, this));
    }

    // gpc: records the shading of samples with the renderer's materials.
    void record_samples(const GpcVisibilitySamples &found) const noexcept {
        if (found.condition) {
            VkConditionalRenderingBeginInfoEXT info{VK_STRUCTURE_TYPE_CONDITIONAL_RENDERING_BEGIN_INFO_EXT};
            info.buffer = found.condition;
            device.begin_conditional(commands, &info); // Rounds that have nothing to do are skipped.
        }
        const VkDescriptorSet sets[] = {found.descriptor_set, set};
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines.samples_layout, 0, 2, sets, 0, nullptr);
        push(pipelines.samples_layout, 0, 0);
        for (uint32_t key = 0; key < KEYS; ++key) {
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines.samples[key]);
            vkCmdDispatchIndirect(commands, found.dispatches, found.dispatch_offset + key * found.dispatch_stride);
        }
        if (found.condition) device.end_conditional(commands);
    }

    void push(VkPipelineLayout layout, uint32_t object, uint32_t first_triangle) const noexcept {
        const Push values{{EYE[0], EYE[1], EYE[2], 1}, object, first_triangle};
        vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_ALL, 0, sizeof values, &values);
    }

    void bind(VkPipelineBindPoint point) const {
        vkCmdBindDescriptorSets(commands, point, pipelines.layout, 0, 1, &set, 0, nullptr);
    }

    // Records the drawing of colours and, for gpc, of triangle IDs.
    void record_forward() const {
        const Image &color = canvas(), &ids = targets->ids, &depth = targets->depth;
        change(color, UNDEFINED, COLOR_DRAWN);
        change(ids, UNDEFINED, COLOR_DRAWN);
        change(depth, UNDEFINED, DEPTH_DRAWN);
        VkRenderingAttachmentInfo colors[2]{}, depths{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
        for (auto [attachment, image] : {std::pair{&colors[0], &color}, {&colors[1], &ids}, {&depths, &depth}}) {
            attachment->sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
            attachment->imageView = image->view;
            attachment->imageLayout = (image == &depth ? DEPTH_DRAWN : COLOR_DRAWN).layout;
            attachment->loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
            attachment->storeOp = VK_ATTACHMENT_STORE_OP_STORE;
        }
        colors[0].clearValue.color = {{SKY[0], SKY[1], SKY[2], 1}};
        depths.clearValue.depthStencil.depth = 1;
        const VkRect2D area{{0, 0}, size};
        VkRenderingInfo rendering{VK_STRUCTURE_TYPE_RENDERING_INFO};
        rendering.renderArea = area;
        rendering.layerCount = 1;
        rendering.colorAttachmentCount = 2;
        rendering.pColorAttachments = colors;
        rendering.pDepthAttachment = &depths;
        vkCmdBeginRendering(commands, &rendering);
        const VkViewport viewport{0, 0, float(size.width), float(size.height), 0, 1};
        vkCmdSetViewport(commands, 0, 1, &viewport);
        vkCmdSetScissor(commands, 0, 1, &area);
        bind(VK_PIPELINE_BIND_POINT_GRAPHICS);
        vkCmdBindIndexBuffer(commands, meshes.indices.raw, 0, VK_INDEX_TYPE_UINT16);
        uint32_t first_triangle = 0;
        for (uint32_t object = 0; object < world.parts.size(); ++object) {
            const auto &[mesh, key, _] = world.parts[object];
            const VkDeviceSize offset = mesh.first_vertex * sizeof(Vertex);
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines.forward[key]);
            vkCmdBindVertexBuffers(commands, 0, 1, &meshes.vertices.raw, &offset);
            push(pipelines.layout, object, first_triangle);
            vkCmdDrawIndexed(commands, 3 * mesh.triangle_count, 1, mesh.first_index, 0, 0);
            first_triangle += mesh.triangle_count;
        }
        vkCmdEndRendering(commands);
    }

    void record_read_back() const {
        VkBufferImageCopy region{};
        region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        region.imageExtent = {size.width, size.height, 1};
        vkCmdCopyImageToBuffer(commands, canvas().raw, COPIED.layout, targets->read_back.raw, 1, &region);
        VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
        barrier.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
        barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
        barrier.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
        barrier.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
        VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
        dependency.memoryBarrierCount = 1;
        dependency.pMemoryBarriers = &barrier;
        vkCmdPipelineBarrier2(commands, &dependency);
    }

    void change(const Image &image, const GpcImageState &from, const GpcImageState &to) const {
        VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
        barrier.srcStageMask = from.stage;
        barrier.srcAccessMask = from.access;
        barrier.dstStageMask = to.stage;
        barrier.dstAccessMask = to.access;
        barrier.oldLayout = from.layout;
        barrier.newLayout = to.layout;
        barrier.image = image.raw;
        barrier.subresourceRange = {image.aspects, 0, 1, 0, 1};
        VkDependencyInfo dependency{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
        dependency.imageMemoryBarrierCount = 1;
        dependency.pImageMemoryBarriers = &barrier;
        vkCmdPipelineBarrier2(commands, &dependency);
    }
};

// A picture rounded to 8-bit codes, as in an image.
Picture rounded(Picture picture) {
    for (double &code : picture) code = std::round(255 * code) / 255;
    return picture;
}

// Root mean squared difference of sRGB codes from 0 to 1.
double error(const Picture &picture, const Picture &truth) {
    double sum = 0;
    for (size_t i = 0; i < picture.size(); ++i) sum += (picture[i] - truth[i]) * (picture[i] - truth[i]);
    return std::sqrt(sum / double(picture.size()));
}

void save(const Picture &picture, const char *path) {
    std::ofstream file(path, std::ios::binary);
    file << "P6\n" << SIZE.width << ' ' << SIZE.height << "\n255\n";
    for (double code : picture) file.put(char(std::lround(255 * code)));
    if (!file.flush()) throw std::runtime_error(std::string(path) + " can't be written");
}

// What all renderers share.
struct Stage {
    const Device device;
    const World world;
    const Meshes meshes;
    std::unique_ptr<GpcAntialiaser, decltype(&gpc_antialiaser_destroy)> antialiaser;
    const Pipelines pipelines;

    explicit Stage(const std::string &shaders)
        : meshes(device, world), antialiaser(make(device), gpc_antialiaser_destroy),
          pipelines(device, shaders, gpc_antialiaser_samples_layout(antialiaser.get())) {}

    std::unique_ptr<Renderer> renderer(const Way &way) const {
        return std::make_unique<Renderer>(device, world, meshes, pipelines, way);
    }

  private:
    static GpcAntialiaser *make(const Device &device) {
        const GpcDevice lent = device.lent();
        GpcAntialiaser *made = nullptr;
        check(gpc_antialiaser_create(&lent, &made));
        return made;
    }
};

void run(const std::string &shaders, const char *out) {
    const Stage stage(shaders);
    const GpcAntialiaser *made = stage.antialiaser.get();
    const float moments[] = {0, 0.5f, 1};
    const std::unique_ptr<Renderer> renderer = stage.renderer({SIZE, 1, made});
    for (float moment : moments) renderer->draw(moment);
    const GpcOutcome outcome = renderer->outcome();
    std::printf("%llu superpixels, %llu left over, %.1f ms of the library on the GPU, %.1f MB\n",
                static_cast<unsigned long long>(outcome.superpixels), static_cast<unsigned long long>(outcome.left_over),
                outcome.gpu_milliseconds, double(outcome.memory_bytes) / 1e6);
    const auto last = [&](const Way &way) { return stage.renderer(way)->picture(moments[2]); };
    const auto placed = [&](GpcShading shading) { return last({SIZE, 1, made, BRUTE * BRUTE, GPC_PATTERN_GRID, shading}); };
    const Picture truth = last({SIZE, REFERENCE}), antialiased = renderer->picture();
    std::printf("error of one sample: %.6f\n", error(last({SIZE}), truth));
    std::printf("error of brute force: %.6f\n", error(rounded(last({SIZE, BRUTE})), truth));
    std::printf("error of superpixels: %.6f\n", error(antialiased, truth));
    std::printf("error of superpixels, samples where brute force has them: %.6f\n",
                error(placed(GPC_SHADING_PART), truth));
    std::printf("error of superpixels, each of these samples shaded: %.6f\n",
                error(placed(GPC_SHADING_SAMPLE), truth));
    std::printf("share of superpixels: %.4f\n", double(outcome.superpixels) / (SIZE.width * SIZE.height));
    const auto [all, shared] = renderer->memory();
    std::printf("memory of a frame: %.1f MB, of another one: %.1f MB\n", double(all) / 1e6, double(all - shared) / 1e6);
    renderer->resize({SIZE.width + 80, SIZE.height + 45});
    renderer->draw(moments[1]);
    renderer->resize(SIZE);
    renderer->draw(moments[2]);
    std::printf("after two resizes: %s\n", renderer->picture() == antialiased ? "the same picture" : "another picture");
    save(antialiased, out);
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

// Prints times and errors of brute force and of the library, for pictures of these sizes. Times are medians of frames that are
// drawn by turns.
void measure(const std::string &shaders, const std::vector<VkExtent2D> &sizes) {
    const Stage stage(shaders);
    const GpcAntialiaser *made = stage.antialiaser.get();
    std::puts("width,height,method,samples,frames,wall_ms_median,cpu_ms_median,rmse,superpixel_fraction");
    for (const VkExtent2D size : sizes) {
        const Picture truth = stage.renderer({size, REFERENCE})->picture(1);
        const Way ways[] = {{size}, {size, 8}, {size, 16}, {size, 1, made, 64}, {size, 1, made, 256}};
        std::vector<std::unique_ptr<Renderer>> renderers;
        std::vector<double> errors;
        for (const Way &way : ways) {
            renderers.push_back(stage.renderer(way));
            errors.push_back(error(rounded(renderers.back()->picture(1)), truth));
        }
        std::vector<std::vector<double>> wall(renderers.size()), cpu(renderers.size());
        for (size_t turn = 0; turn < TIMED; ++turn)
            for (size_t i = 0; i < renderers.size(); ++i) {
                const Time time = renderers[i]->draw_all(1);
                wall[i].push_back(time.wall);
                cpu[i].push_back(time.cpu);
            }
        for (size_t i = 0; i < renderers.size(); ++i) {
            const Way &way = ways[i];
            const char *method = way.antialiaser ? "superpixel" : way.side > 1 ? "own" : "none";
            const GpcOutcome outcome = way.antialiaser ? renderers[i]->outcome() : GpcOutcome{};
            if (outcome.left_over) throw std::runtime_error("a frame was left unfinished");
            std::printf("%u,%u,%s,%u,%zu,%.3f,%.3f,%.6f,%.4f\n", size.width, size.height, method,
                        way.antialiaser ? way.samples : way.side * way.side, TIMED, median(wall[i]), median(cpu[i]), errors[i],
                        double(outcome.superpixels) / (double(size.width) * size.height));
        }
        std::fflush(stdout);
    }
}

// Sizes of a list such as 240x135,480x270; empty if it is no such list.
std::vector<VkExtent2D> sizes_of(const char *list) {
    std::vector<VkExtent2D> sizes;
    for (const char *rest = list;; ++rest) {
        VkExtent2D size{};
        int read = 0;
        if (std::sscanf(rest, "%5ux%5u%n", &size.width, &size.height, &read) != 2 || !size.width || !size.height) return {};
        sizes.push_back(size);
        rest += read;
        if (!*rest) return sizes;
        if (*rest != ',') return {};
    }
}

} // namespace

int main(int count, char **arguments) {
    const char *usage = "forward SPIRV_FOLDER OUT.ppm, or forward SPIRV_FOLDER --sizes WIDTHxHEIGHT,...";
    const bool measures = count > 2 && std::string(arguments[2]) == "--sizes";
    const int expected = measures ? 4 : 3;
    for (int i = 1; i < count; ++i) {
        const std::string argument = arguments[i];
        if (argument == "--help" || argument == "-h") {
            std::printf("Usage: %s\n", usage);
            return 0;
        }
        if (i >= expected || (argument[0] == '-' && !(measures && i == 2))) {
            std::fprintf(stderr, "unexpected argument \"%s\"; usage: %s\n", arguments[i], usage);
            return 2;
        }
    }
    if (count != expected) {
        std::fprintf(stderr, "a %s is missing; usage: %s\n", measures ? "list of sizes" : "path", usage);
        return 2;
    }
    std::vector<VkExtent2D> sizes;
    if (measures && (sizes = sizes_of(arguments[3])).empty()) {
        std::fprintf(stderr, "\"%s\" is no list of sizes such as 240x135,480x270; usage: %s\n", arguments[3], usage);
        return 2;
    }
    try {
        if (measures) measure(arguments[1], sizes);
        else run(arguments[1], arguments[2]);
    } catch (const std::exception &failure) {
        std::fprintf(stderr, "%s\n", failure.what());
        return 1;
    }
}
