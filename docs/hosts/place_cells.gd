# exemplar: give it one example; get as much more of it as you want.
# Copyright (c) 2026 The exemplar authors. SPDX-License-Identifier: MIT
#
# Godot 3: puts pieces where cells have them. Beside project.godot are
#   exemplar synth castle --size 40,40,7 -o cells.json --pieces pieces.glb
# In a game, `place` is called with a node of the scene; by itself (godot3 -s place_cells.gd) it says
# what it has placed.
extends SceneTree


# Adds a MeshInstance to `parent` for each cell; meters, y up.
static func place(parent, library_path, cells_path):
	var meshes = {}
	var library = load(library_path).instance()
	for node in library.get_children():
		meshes[node.name] = node.mesh
	var file = File.new()
	file.open(cells_path, File.READ)
	var placed = JSON.parse(file.get_as_text()).result
	file.close()
	var size = placed["size"]
	var side = placed["cell_size"]
	var origin = placed["origin"]
	for n in range(len(placed["cells"])):
		if placed["cells"][n] < 0:
			continue
		var piece = placed["pieces"][placed["cells"][n]]
		# x fastest, then y, then z; the file's z is up.
		var x = n % int(size[0])
		var y = (n / int(size[0])) % int(size[1])
		var z = n / int(size[0] * size[1])
		var basis = Basis(Vector3(0, 1, 0), PI / 2 * piece["turns"])
		if piece["mirror"]:
			basis = basis * Basis().scaled(Vector3(-1, 1, 1))
		var instance = MeshInstance.new()
		instance.mesh = meshes[piece["name"]]
		instance.transform = Transform(basis, Vector3(
			origin[0] + (x + 0.5) * side[0],
			origin[2] + (z + 0.5) * side[2],
			-origin[1] - (y + 0.5) * side[1]))
		parent.add_child(instance)
	library.free()


# Sums over a scene's triangles, in the file's axes: area, and area times the middle.
static func sums(parent):
	var all = [0.0, 0.0, 0.0, 0.0]
	for instance in parent.get_children():
		var points = instance.mesh.get_faces()
		for t in range(0, len(points), 3):
			var a = instance.transform.xform(points[t])
			var b = instance.transform.xform(points[t + 1])
			var c = instance.transform.xform(points[t + 2])
			var area = (b - a).cross(c - a).length() / 2
			var middle = (a + b + c) / 3
			all[0] += area
			all[1] += area * middle.x
			all[2] -= area * middle.z
			all[3] += area * middle.y
	return all


func _init():
	var parent = Spatial.new()
	place(parent, "res://pieces.glb", "res://cells.json")
	print("placed ", parent.get_child_count(), " ", sums(parent))
	parent.free()
	quit()
