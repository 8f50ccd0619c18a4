try { document.documentElement.dataset.theme = localStorage.getItem("clackers-theme") || "auto"; } catch (e) {}
