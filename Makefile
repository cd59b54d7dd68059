# `make demo` and `make test` install what they need: see tools/setup.sh.

CARGO ?= cargo

# Tests run on Mesa's software driver, so that they mean the same on every machine; a driver named in
# VK_ICD_FILENAMES or VK_DRIVER_FILES comes first. Looked up by the shell, after it has been installed.
LAVAPIPE = ls /usr/share/vulkan/icd.d/lvp_icd*.json /etc/vulkan/icd.d/lvp_icd*.json 2>/dev/null | paste -sd :

# Options of `gpc bench`. These take about half an hour on two cores without a GPU; its own defaults (BENCH=) take
# hours there.
BENCH ?= --size 480x270 --samples 4,16,64,256 --reference 1024 --budget 4

.PHONY: help demo test bench lint shaders check-shaders assets

help:
	@echo "make demo           build, render a scene without and with antialiasing into out/"
	@echo "make test           run all tests, without a GPU"
	@echo "make bench          measure cost and accuracy of all methods into out/bench; BENCH='...' are its options"
	@echo "make lint           check formatting, clippy's advice for each set of features, and the documentation"
	@echo "make shaders        compile shaders/ into shaders/spirv (builds shaderc: some 10 minutes once)"
	@echo "make check-shaders  check that shaders/spirv is what shaders/ compiles to"
	@echo "make assets         write the scenes in assets/ again"

demo:
	@tools/setup.sh build vulkan
	$(CARGO) build --release --bin gpc
	@tools/demo.sh

test:
	@tools/setup.sh build lavapipe validation
	VK_ICD_FILENAMES="$${VK_ICD_FILENAMES:-$$($(LAVAPIPE))}" $(CARGO) test --release

bench:
	@tools/setup.sh build vulkan
	$(CARGO) build --release --bin gpc
	@tools/bench.sh out/bench $(BENCH)

lint:
	@tools/setup.sh build
	$(CARGO) fmt --check
	$(CARGO) clippy --release --all-targets -- -D warnings
	$(CARGO) clippy --release --no-default-features -- -D warnings
	$(CARGO) clippy --release --no-default-features --features gltf -- -D warnings
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc --release --no-deps

# The build script does the work; `check` spares the crate's own code generation.
shaders:
	@tools/setup.sh shaders
	GPC_SPIRV=write $(CARGO) check --release --features compile-shaders

check-shaders:
	@tools/setup.sh shaders
	GPC_SPIRV=check $(CARGO) check --release --features compile-shaders

assets:
	@tools/setup.sh build
	$(CARGO) run --release --example generate_assets
