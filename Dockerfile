# The command with Mesa's software driver: renders without a GPU. See docs/sequences.md.
#   docker build -t gpc .
#   docker run --rm -v "$PWD:/data" --user "$(id -u):$(id -g)" gpc render scene.glb -o image.png
FROM rust:1-trixie AS build
WORKDIR /source
COPY . .
RUN cargo build --release --locked --bin gpc && strip target/release/gpc

FROM debian:trixie-slim
RUN apt-get update \
    && apt-get install -y --no-install-recommends libvulkan1 mesa-vulkan-drivers \
    && rm -rf /var/lib/apt/lists/*
COPY --from=build /source/target/release/gpc /usr/local/bin/gpc
# Any user may render, and keeps compiled kernels between runs in one container.
ENV XDG_CACHE_HOME=/tmp/cache
WORKDIR /data
ENTRYPOINT ["gpc"]
