# `make demo` and `make test` install what they need: see tools/setup.sh.

CARGO ?= cargo

# Tests run on Mesa's software driver, so that results are the same on every machine, unless VK_ICD_FILENAMES or
# VK_DRIVER_FILES names another driver. The shell runs this command when the driver has been installed.
LAVAPIPE = ls /usr/share/vulkan/icd.d/lvp_icd*.json /etc/vulkan/icd.d/lvp_icd*.json 2>/dev/null | paste -sd :

# Options of `gpc bench`. With these it takes about half an hour on two cores without a GPU. With its own defaults
# (BENCH=) it takes hours there.
BENCH ?= --size 480x270 --samples 4,16,64,256 --reference 1024 --budget 4

# Where `make install` puts the C library. The shared library's name (SONAME) has the version of the binary interface.
PREFIX ?= /usr/local
DESTDIR ?=
VERSION = $(shell sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml)
SONAME = libgpc.so.$(shell sed -n 's/^pub const GPC_ABI_VERSION: u32 = \(.*\);/\1/p' src/capi/version.rs)

# Scene that `make view` opens.
SCENE ?= assets/letters.glb

# Scenes that `make pack-gpu` packs besides those of assets/, and options of tools/pack-gpu.sh.
SCENES ?=
PACK ?=

.PHONY: help demo view test test-view test-gpu pack-gpu test-drivers test-compilers test-slang test-bounds bench measure figures pictures lint shaders check-shaders \
	header assets install wheel test-wheel dist test-dist

help:
	@echo "make demo           build, render a scene without and with antialiasing into out/"
	@echo "make view           open a window on a scene; SCENE=... is the file"
	@echo "make test           run all tests, without a GPU"
	@echo "make test-view      run the tests of the window, on a display of their own"
	@echo "make test-gpu       test the passes, images and hosts on this machine's GPU, and measure times there"
	@echo "make pack-gpu       pack what test-gpu runs, for a machine with a GPU and without Rust; SCENES='...' are further scenes"
	@echo "make test-drivers   run the tests of the passes on every driver that can be had here"
	@echo "make test-compilers compile the kernels for GPUs that are not there, and check what their compilers say"
	@echo "make test-slang     compile the include in Slang, and compare it with that in GLSL"
	@echo "make test-bounds    check that no shader reads or writes beyond the end of a buffer"
	@echo "make bench          measure cost and accuracy of all methods into out/bench; BENCH='...' are its options"
	@echo "make measure        write docs/bench/*.csv of this machine's driver again (an hour); KINDS='...' are some of them;"
	@echo "                    KINDS='views many large' are full frames (hours without a GPU)"
	@echo "make figures        write the tables, plots and help texts of the documents from the data and the command"
	@echo "make pictures       render the pictures of the documents again"
	@echo "make lint           check formatting, clippy's advice for each set of features, and the documentation"
	@echo "make shaders        compile shaders/ into shaders/spirv, and write their interfaces into src/engine/spirv.rs"
	@echo "                    (builds shaderc: some 10 minutes once)"
	@echo "make check-shaders  check that both are what shaders/ compiles to"
	@echo "make header         write include/gpc.h, the C header, again"
	@echo "make install        build the C library and install it below PREFIX, which is $(PREFIX)"
	@echo "make wheel          build the Python package into out/wheel"
	@echo "make test-wheel     install it into an empty environment and test it there"
	@echo "make dist           write archives and packages of the command and the C library into out/dist"
	@echo "make test-dist      install and run these in empty Debian systems (needs root and debootstrap)"
	@echo "make assets         write the scenes in assets/ again"

demo:
	@tools/setup.sh build vulkan
	$(CARGO) build --profile demo --bin gpc
	@tools/demo.sh

view:
	@tools/setup.sh build vulkan window
	$(CARGO) run --release --features view --bin gpc -- view $(SCENE)

test:
	@tools/setup.sh build lavapipe validation c
	VK_ICD_FILENAMES="$${VK_ICD_FILENAMES:-$$($(LAVAPIPE))}" $(CARGO) test --release --workspace --features capi --no-fail-fast

test-view:
	@tools/setup.sh build lavapipe validation c window display
	$(CARGO) build --release --features view --example window
	VK_ICD_FILENAMES="$${VK_ICD_FILENAMES:-$$($(LAVAPIPE))}" \
		$(CARGO) test --release --features view --no-fail-fast --bin gpc --test view

# Lavapipe renders the images with which those of the GPU are compared.
test-gpu:
	@tools/setup.sh build lavapipe validation c
	@tools/pack-gpu.sh $(PACK) out/gpu $(SCENES)
	@out/gpu/run.py --out out/gpu-results

pack-gpu:
	@tools/setup.sh build lavapipe validation c
	@tools/pack-gpu.sh $(PACK) out/gpc-gpu.tar.xz $(SCENES)

# Takes an hour: each driver compiles all shaders.
test-drivers:
	@tools/setup.sh build lavapipe validation
	@tools/test-drivers.sh $(DRIVERS)

# Takes minutes.
test-compilers:
	@tools/setup.sh build lavapipe c
	@tools/test-compilers.sh $(HARDWARE)

test-slang:
	@tools/setup.sh build lavapipe c python
	@VK_ICD_FILENAMES="$${VK_ICD_FILENAMES:-$$($(LAVAPIPE))}" tools/test-slang.sh

# Takes half an hour: the validation layer checks and compiles all shaders.
test-bounds:
	@tools/setup.sh build lavapipe
	@tools/test-bounds.sh $(IMAGES)

bench:
	@tools/setup.sh build vulkan
	$(CARGO) build --release --bin gpc
	@tools/bench.sh out/bench $(BENCH)

measure:
	@tools/setup.sh build vulkan
	@tools/measure.sh $(KINDS)

figures:
	@tools/setup.sh build
	GPC_FIGURES=write $(CARGO) test --release --test figures documents_agree

pictures:
	@tools/setup.sh build lavapipe pictures
	@tools/pictures.sh

lint:
	@tools/setup.sh build python
	$(CARGO) fmt --all --check
	$(CARGO) clippy --release --workspace --all-targets --features capi -- -D warnings
	$(CARGO) clippy --release --all-targets --features view -- -D warnings
	$(CARGO) clippy --release --no-default-features -- -D warnings
	$(CARGO) clippy --release --no-default-features --features capi -- -D warnings
	$(CARGO) clippy --release --no-default-features --features gltf -- -D warnings
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc --release --no-deps

# The build script does the work. `cargo check` saves the time of generating code for the crate.
shaders:
	@tools/setup.sh shaders
	GPC_SPIRV=write $(CARGO) check --release --features compile-shaders

check-shaders:
	@tools/setup.sh shaders
	GPC_SPIRV=check $(CARGO) check --release --features compile-shaders

assets:
	@tools/setup.sh build
	$(CARGO) run --release --example generate_assets

header:
	@tools/setup.sh build
	GPC_HEADER=write $(CARGO) test --release --test hosts header

# The crate types of the C library are set only here, so that `cargo build` does not make it.
install:
	@tools/setup.sh build
	$(CARGO) rustc --release --lib --no-default-features --features capi --crate-type cdylib,staticlib -- \
		-C link-arg=-Wl,-soname,$(SONAME)
	@tools/install.sh $(or $(CARGO_TARGET_DIR),target)/release $(VERSION) $(SONAME) $(abspath $(PREFIX)) $(DESTDIR)

wheel:
	@tools/setup.sh build python
	@tools/wheel.sh

test-wheel:
	@tools/setup.sh build lavapipe validation python
	@VK_ICD_FILENAMES="$${VK_ICD_FILENAMES:-$$($(LAVAPIPE))}" tools/wheel.sh test

dist:
	@tools/setup.sh build window
	@tools/dist.sh

test-dist:
	@tools/test-dist.sh out/dist
