-- NanoPLC sequences in Neovim 0.7 and later, with the client that is built in.
--   require("seqc").setup()                                   seqc is in PATH
--   require("seqc").setup({ cmd = { "/opt/bin/seqc", "lsp" }, verify = false })
local M = {}

local kinds = { seq = "seqc", seqi = "seqc", scn = "seqc-scenario", prop = "seqc-property" }

local function root_of(buffer)
  local folder = vim.fn.fnamemodify(vim.api.nvim_buf_get_name(buffer), ":p:h")
  return folder
end

local function path_of(uri)
  return vim.uri_to_fname(uri)
end

--- What the lenses above PROGRAM do here: `:lua vim.lsp.codelens.run()`.
local function add_commands(options)
  vim.lsp.commands["seqc.verify"] = function(command, context)
    local client = vim.lsp.get_client_by_id(context.client_id)
    client.request("workspace/executeCommand", { command = "seqc.verify.results", arguments = command.arguments }, function(problem, result)
      if problem then return vim.notify(problem.message, vim.log.levels.ERROR) end
      for _, one in ipairs(result.results) do
        print(one.level .. "  " .. one.name .. "  " .. one.message)
      end
    end)
  end
  local function rehearse(program, scenario)
    local words = { options.simulator, "run", program }
    if scenario then vim.list_extend(words, { "--scenario", scenario }) end
    vim.cmd("botright new")
    if vim.fn.executable(words[1]) == 0 then return vim.notify(words[1] .. " is missing: install the package seqc", vim.log.levels.ERROR) end
    vim.fn.termopen(words)
  end
  vim.lsp.commands["seqc.rehearse"] = function(command)
    rehearse(path_of(command.arguments[1]), command.arguments[2] and path_of(command.arguments[2]))
  end
  --- The scenario in which a property breaks, kept beside the program and rehearsed.
  vim.lsp.commands["seqc.counterexample.open"] = function(command, context)
    local client = vim.lsp.get_client_by_id(context.client_id)
    client.request("workspace/executeCommand", { command = "seqc.counterexample", arguments = command.arguments }, function(problem, result)
      if problem then return vim.notify(problem.message, vim.log.levels.ERROR) end
      local program = path_of(result.program)
      local scenario = vim.fn.fnamemodify(program, ":r") .. "-" .. result.name .. ".scn"
      vim.fn.writefile(vim.split(result.scenario, "\n"), scenario)
      rehearse(program, scenario)
    end)
  end
  vim.lsp.commands["seqc.graph"] = function(command)
    local file = path_of(command.arguments[1])
    local drawing = vim.fn.fnamemodify(file, ":r") .. ".svg"
    vim.fn.system({ options.cmd[1], "graph", file, "-o", drawing })
    print("drawn: " .. drawing)
  end
  vim.lsp.commands["seqc.upload"] = function()
    print("nanoctl --port EP upload F.bin")
  end
end

--- Starts the server for a buffer, or joins the one that runs; its client's number.
function M.attach(buffer, options)
  local root = root_of(buffer)
  for _, client in pairs(vim.lsp.get_active_clients()) do
    if client.name == "seqc" and client.config.root_dir == root then
      vim.lsp.buf_attach_client(buffer, client.id)
      return client.id
    end
  end
  local id = vim.lsp.start_client({
    name = "seqc",
    cmd = options.cmd,
    root_dir = root,
    workspace_folders = { { uri = vim.uri_from_fname(root), name = root } },
    init_options = { verify = options.verify },
    get_language_id = function(_, filetype) return filetype end,
    on_attach = options.on_attach,
  })
  if id then vim.lsp.buf_attach_client(buffer, id) end
  return id
end

function M.setup(options)
  options = vim.tbl_extend("keep", options or {}, { cmd = { "seqc", "lsp" }, simulator = "nanoplc-sim", verify = true })
  add_commands(options)
  local group = vim.api.nvim_create_augroup("seqc", {})
  local done = {}
  for ending, filetype in pairs(kinds) do
    vim.api.nvim_create_autocmd({ "BufRead", "BufNewFile" }, { group = group, pattern = "*." .. ending, command = "setfiletype " .. filetype })
    if not done[filetype] then vim.api.nvim_create_autocmd("FileType", {
      group = group,
      pattern = filetype,
      callback = function(event)
        vim.bo[event.buf].commentstring = filetype == "seqc-scenario" and "# %s" or "// %s"
        vim.bo[event.buf].omnifunc = "v:lua.vim.lsp.omnifunc"
        M.attach(event.buf, options)
      end,
    }) end
    done[filetype] = true
  end
end

return M
