// What the C code of the README needs besides what it shows: the application's structs, filled as docs/embedding.md says.
#include <gpc.h>

GpcDevice device;
GpcGeometry geometry;
GpcImageKinds kinds;
GpcOptions options;
GpcImages images;
GpcScenery scenery;
VkCommandBuffer commands;
void *user;
void shade(void *user, VkCommandBuffer commands, const GpcVisibilitySamples *samples);
