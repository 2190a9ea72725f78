-- Neovim as a foreign client: each feature once on an example. Writes what went wrong to the file $REPORT.
local report = {}
local function check(condition, what)
  if not condition then table.insert(report, what) end
end

vim.opt.runtimepath:append(os.getenv("SEQC_NVIM"))
require("seqc").setup({ cmd = { os.getenv("SEQC"), "lsp" }, verify = true })
vim.cmd("edit " .. os.getenv("PROGRAM"))

local buffer = vim.api.nvim_get_current_buf()
local function client()
  return vim.lsp.get_active_clients()[1]
end
check(vim.wait(10000, function() return client() ~= nil and client().server_capabilities.hoverProvider ~= nil end, 20), "no client")

local function text()
  return table.concat(vim.api.nvim_buf_get_lines(buffer, 0, -1, false), "\n")
end
local function find(words, shift)
  for number, line in ipairs(vim.api.nvim_buf_get_lines(buffer, 0, -1, false)) do
    local at = line:find(words, 1, true)
    if at then return { line = number - 1, character = at - 1 + (shift or 0) } end
  end
  error("not in the text: " .. words)
end
local function ask(method, parameters)
  local answers, problem = vim.lsp.buf_request_sync(buffer, method, parameters, 10000)
  if not answers then
    check(false, method .. ": " .. tostring(problem))
    return {}
  end
  local _, answer = next(answers)
  if answer.error then check(false, method .. ": " .. answer.error.message) end
  return answer.result or {}
end
local document = { uri = vim.uri_from_bufnr(buffer) }
local function at(words, shift, more)
  return vim.tbl_extend("force", { textDocument = document, position = find(words, shift) }, more or {})
end
local all = { start = { line = 0, character = 0 }, ["end"] = { line = 10000, character = 0 } }
local layout = { tabSize = 4, insertSpaces = true }

check(ask("textDocument/hover", at("60 mm")).contents.value:find("49152"), "hover without the raw value")
check(#ask("textDocument/completion", at("Travel; END_IF")).items == 7, "completion of steps")
check(ask("completionItem/resolve", { label = "POSITION", data = { uri = document.uri } }).documentation, "documentation of POSITION")
check(ask("textDocument/signatureHelp", at("POSITION(Place", 10)).signatures[1].label:find("POSITION"), "signature")
check(ask("textDocument/definition", at("Hold;")).range.start.line == find("Hold:").line, "definition")
check(#ask("textDocument/references", at("Grip AT", 0, { context = { includeDeclaration = true } })) >= 3, "references")
check(#ask("textDocument/documentHighlight", at("Grip AT")) == 3, "highlights")
check(#ask("textDocument/documentSymbol", { textDocument = document })[1].children > 10, "symbols")
check(#ask("workspace/symbol", { query = "travel" }) > 0, "workspace symbols")
check(#ask("textDocument/foldingRange", { textDocument = document }) > 10, "folding")
check(ask("textDocument/selectionRange", { textDocument = document, positions = { find("T#500ms") } })[1].parent, "selection")
check(#ask("textDocument/semanticTokens/full", { textDocument = document }).data > 500, "colours")
check(#ask("textDocument/inlayHint", { textDocument = document, range = all }) > 5, "hints")
check(#ask("textDocument/codeLens", { textDocument = document }) > 3, "lenses")
check(#ask("textDocument/formatting", { textDocument = document, options = layout }) == 0, "the example is laid out already")
check(#ask("textDocument/rangeFormatting", { textDocument = document, range = all, options = layout }) == 0, "range")
check(ask("textDocument/prepareRename", at("Grip AT")).placeholder == "Grip", "prepareRename")
check(ask("workspace/executeCommand", { command = "seqc.dot", arguments = { document.uri } }).dot:find("digraph"), "graph")

-- What Neovim shows by itself: verdicts, and messages while typing.
check(vim.wait(20000, function()
  for _, told in ipairs(vim.diagnostic.get(buffer)) do
    if told.source == "seqc verify" and told.message:find("^proved") then return true end
  end
end, 50), "no verdict")
local typed = find("Travel; END_IF")
vim.api.nvim_buf_set_text(buffer, typed.line, typed.character, typed.line, typed.character + 6, { "Travle" })
local function mistakes()
  return vim.diagnostic.get(buffer, { severity = vim.diagnostic.severity.ERROR })
end
check(vim.wait(10000, function() return #mistakes() == 1 end, 20), "no message for a misspelt step")

-- The quick fix, applied by Neovim.
local told = { range = { start = typed, ["end"] = { line = typed.line, character = typed.character + 6 } }, context = { diagnostics = {} }, textDocument = document }
local actions = ask("textDocument/codeAction", told)
vim.lsp.util.apply_workspace_edit(actions[1].edit, "utf-16")
check(vim.wait(10000, function() return #mistakes() == 0 end, 20), "the fix left a mistake")
check(text():find("NEXT := Travel; END_IF", 1, true), "the fix wrote something else")

-- Rename, applied by Neovim, and laid out again by the server.
vim.lsp.util.apply_workspace_edit(ask("textDocument/rename", at("Grip AT", 0, { newName = "Gripper" })), "utf-16")
check(text():find("OUT Gripper;", 1, true), "rename")
vim.lsp.buf.formatting_sync(layout, 10000)
check(#mistakes() == 0, "a mistake after rename")
vim.api.nvim_buf_set_lines(buffer, 0, 0, false, { "", "" })
vim.api.nvim_buf_set_lines(buffer, 0, 2, false, {})
vim.wait(500, function() return false end, 50)
check(#mistakes() == 0, "a mistake after edits that undo each other")

-- Several fixes at once, and the depth of a line while typing.
vim.api.nvim_buf_set_lines(buffer, 0, -1, false, { "PROGRAM P", "STEP S:", "    OWN ERROR;", "    IF IN0 THEN NXT := S END_IF", "END_STEP", "END_PROGRAM" })
check(vim.wait(10000, function() return #mistakes() == 2 end, 20), "not two mistakes")
local fix = ask("textDocument/codeAction", { textDocument = document, range = all, context = { diagnostics = {}, only = { "source.fixAll" } } })
vim.lsp.util.apply_workspace_edit(fix[1].edit, "utf-16")
check(vim.wait(10000, function() return #mistakes() == 0 end, 20), "a mistake after source.fixAll")
vim.api.nvim_buf_set_lines(buffer, 3, 3, false, { "" })
local depth = ask("textDocument/onTypeFormatting", { textDocument = document, position = { line = 3, character = 0 }, ch = "\n", options = layout })
check(depth[1] and depth[1].newText == "    ", "the depth of a new line")
vim.cmd("edit!")

-- A scenario and a file of properties: names of the program, errors in place, verdicts, the way in which one breaks.
local function open(name)
  vim.cmd("edit " .. vim.fn.fnamemodify(os.getenv("PROGRAM"), ":h") .. "/" .. name)
  buffer = vim.api.nvim_get_current_buf()
  document = { uri = vim.uri_from_bufnr(buffer) }
  check(vim.wait(10000, function() return #vim.lsp.buf_get_clients(buffer) == 1 end, 20), "no client for " .. name)
end
open("pick_and_place.scn")
check(ask("textDocument/definition", at("Guard 600")).uri:find("pick_and_place.seq"), "definition from a scenario")
check(ask("textDocument/hover", at("Guard 600")).contents.value:find("IX0.1"), "hover in a scenario")
check(ask("textDocument/rename", at("Guard 600", 0, { newName = "Door" })).changes, "rename from a scenario")
check(#ask("textDocument/documentSymbol", { textDocument = document }) > 10, "outline of a scenario")
local guard = find("Guard 600")
vim.api.nvim_buf_set_text(buffer, guard.line, guard.character, guard.line, guard.character + 5, { "Gaurd" })
check(vim.wait(10000, function() return #mistakes() > 0 end, 20), "no message in a scenario")
local mended = ask("textDocument/codeAction", { textDocument = document, range = all, context = { diagnostics = {} } })
check(mended[1] and mended[1].title == "Write 'Guard'", "quick fix in a scenario")
vim.cmd("edit!")
open("pick_and_place.prop")
check(vim.wait(20000, function() return #mistakes() == 1 end, 50), "no verdict on a property of a file")
local lenses = ask("textDocument/codeLens", { textDocument = document })
check(lenses[2] and lenses[2].command.command == "seqc.counterexample.open", "no lens above what is broken")
vim.lsp.commands["seqc.counterexample.open"](lenses[2].command, { client_id = client().id })
check(vim.wait(10000, function() return vim.fn.filereadable(vim.fn.fnamemodify(os.getenv("PROGRAM"), ":r") .. "-Wrong.scn") == 1 end, 50), "no counter-example")

local file = io.open(os.getenv("REPORT"), "w")
file:write(table.concat(report, "\n"))
file:close()
vim.cmd("qall!")
