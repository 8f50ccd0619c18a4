# Not run; see ../README.md.
class Clackers < Formula
  desc "Exact motions of colliding structures, and verdicts on time-integration methods"
  url "SOURCE/clackers-0.1.0.tar.gz"
  sha256 "0000000000000000000000000000000000000000000000000000000000000000"
  license "Apache-2.0"

  depends_on "boost" => :build
  depends_on "cmake" => :build
  depends_on "eigen" => :build
  depends_on "nlohmann-json" => :build
  depends_on "node" => :build
  depends_on "tomlplusplus" => :build
  depends_on "flint"
  depends_on "fmt"
  depends_on "highway"
  depends_on :linux
  depends_on "sqlite"

  def install
    system "cmake", "-B", "build", "-DCLACKERS_TESTS=OFF", "-DCLACKERS_MPI=OFF", *std_cmake_args
    system "cmake", "--build", "build"
    system "cmake", "--install", "build"
  end

  test do
    assert_match "agrees", shell_output("#{bin}/clackers verify rk4 --levels 5")
  end
end
