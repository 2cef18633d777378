# 简体中文

## actions

actions-open-a-session-first = 请先打开一个测量
actions-redo = 重做
actions-nothing-was-undone = 没有撤销过操作
actions-undo = 撤销
actions-nothing-was-changed-yet = 尚未做任何更改
actions-import = 导入…
actions-save-session-as = 测量另存为…
actions-save-session-to-path = 将测量保存到路径…
actions-compensate-targets = 补偿目标点…
actions-save-table = 保存表格…
actions-read-the-file-again = 重新读取文件
actions-the-session-is-in-no = 该测量尚未存入文件
actions-the-samples-are-in-no = 样本没有单独的文件
actions-history-of-the-machine = 机器历史…
actions-record-from-an-instrument = 从测量仪器记录…
actions-quit = 退出
actions-cancel-what-is-running = 取消正在运行的任务
actions-nothing-is-running = 没有正在运行的任务
actions-choose-a-sample = 请在图或表中选择一个样本
actions-preferences = 首选项…
actions-workspace-from-above = 工作空间俯视图
actions-workspace-from-the-side = 工作空间侧视图
actions-workspace-from-the-front = 工作空间前视图
actions-deviation-around-the-angle = 沿角度的偏差
actions-workspace-in-3-d = 三维工作空间
actions-show-everything-in-the-plots = 在图中显示全部
actions-this-robot-has-no-such = 该机器人没有此步骤
actions-about-truepose = 关于 truepose
actions-all-commands = 所有命令…
actions-include-again = 重新纳入{ $what }
actions-exclude = 排除{ $what }
actions-stop-following-the-file = 停止跟踪文件
actions-lengths-in-m = 长度单位 µm
actions-lengths-in-inches = 长度单位 英寸
actions-lengths-in-mm = 长度单位 mm
actions-angles-in-radians = 角度单位 弧度
actions-angles-in-mrad = 角度单位 mrad
actions-angles-in-arcsec = 角度单位 角秒
actions-angles-in-degrees = 角度单位 度
actions-light = 浅色
actions-dark = 深色
actions-hide-results = 隐藏结果
actions-show-results = 显示结果

## common

common-identify-the-robot-first = 请先辨识机器人
common-open = 打开…
common-new-by-simulation = 通过仿真新建…
common-save-session = 保存测量
common-save-model = 保存模型…
common-report-details = 报告信息…
common-report = 报告…
common-identify = 辨识
common-identify-2 = 辨识
common-run-diagnosis = 运行诊断
common-3-d-view-isometric = 三维视图，等轴测
common-3-d-view = 三维视图，前视
common-3-d-view-from-the-side = 三维视图，侧视
common-3-d-view-from-above = 三维视图，俯视
common-glossary = 术语表
common-keyboard-and-mouse = 键盘和鼠标
common-follow-the-file-as = 跟踪不断增长的文件
common-time = 时间
common-joints = 关节
common-table = 表格
common-before = 校正前
common-after = 校正后
common-effect = 效应
common-without = 不含该效应
common-moving-positive = 正向运动
common-negative = 负向
common-noise-alone = 仅噪声
common-samples = 样本
common-noise = 噪声
common-degrees = 度
common-radians = 弧度
common-there-is-no-such-region = 没有这个区域
common-tolerance = 公差
common-from = 从
common-to = 到
common-step = 步长
common-corrected = 已修正
common-cancel = 取消
common-done = 完成
common-excluded = 已排除
common-session = 测量
common-decimal-sign = 小数点
common-lengths = 长度单位
common-none = 无
common-which-robot-was-measured = 测量的是哪台机器人
common-tool = 工具
common-save-table = 保存表格
common-save-model-2 = 保存模型
common-save-measuring-list = 保存测量清单
common-save-report = 保存报告
common-save-picture = 保存图片
common-save-corrected-file = 保存修正后的文件
common-instrument = 测量仪器
common-targets-and-programs = 目标点和程序
common-table-2 = 表格
common-and-more = 以及另外 { $more } 项
common-the-simulation-needs-other-numbers = 仿真需要其他数值
common-deviation = 偏差
common-direction = 方向
common-export = 导出
common-chart = 图表
common-copy-table = 复制表格
common-within-tolerance = 在公差内
common-noise-floor = 噪声下限
common-testable-effects = 可检验的效应
common-of = { $yes } / { $no }
common-is-not-there-any-more = { $name } 已不存在
common-not-yet = 尚未
common-joint = 关节
common-not-correctable-by-joint-commands = 无法通过关节指令修正
common-robot = 机器人
common-rms-error = RMS 误差
common-show-these-samples = 显示这些样本
common-estimated = 估计值
common-held-out = 留出
common-the-fit-did-not-converge = 拟合未收敛：{ $stopped }
common-sample = 样本 { $sample }
common-identified = 已辨识
common-searching = 正在搜索
common-continue-to-export = 继续：导出
common-regions = 区域
common-recent-files = 最近的文件
common-forget = 移除 { $name }
common-measured = 实测
common-there-are-no-samples = 没有可绘制的样本
common-continue-to-identify = 继续：辨识
common-results = 结果
common-instrument-2 = 测量仪器
common-open-2 = 打开
common-workspace = 工作空间
common-dismiss = 关闭
common-within = 内
common-outside = 外
common-vectors = 矢量
common-heat-map = 热图
common-load = 负载
common-temperature = 温度
samples = { $count } 个样本
regions = { $count } 个区域
effects = { $count } 个效应
nothing = {""}

## keys

keys-redo = 重做
keys-undo = 撤销
keys-open-the-last-file-again = 重新打开上一个文件
keys-open-a-file = 打开文件
keys-import-what-an-instrument-wrote = 导入仪器写出的文件
keys-first-example = 第一个示例
keys-second-example = 第二个示例
keys-third-example = 第三个示例
keys-new-by-simulation = 通过仿真新建
keys-save-session-as = 测量另存为
keys-save-session = 保存测量
keys-save-session-to-a-path = 将测量保存到路径
keys-save-model = 保存模型
keys-correct-targets-or-a-program = 修正目标点或程序
keys-save-table = 保存表格
keys-save-the-report = 保存报告
keys-read-the-file-again = 重新读取文件
keys-follow-the-file-or-stop = 跟踪文件或停止
keys-report-details = 报告中的客户与机器信息
keys-history-of-the-machine = 比较这台机器的各次测量
keys-record-from-an-instrument = 从测量仪器记录
keys-quit = 退出
keys-search-for-what-is-missing = 搜索缺少的效应
keys-cancel = 取消
keys-exclude-the-chosen-samples-or = 排除所选样本，或重新纳入
keys-preferences = 首选项
keys-other-unit-of-angles = 切换角度单位
keys-next-unit-of-lengths = 下一个长度单位
keys-light-or-dark = 浅色或深色
keys-results-or-more-room = 结果，或给图更多空间
keys-workspace-from-above = 工作空间俯视图
keys-workspace-from-the-side = 工作空间侧视图
keys-workspace-from-the-front = 工作空间前视图
keys-deviation-around-the-angle-polar = 沿角度的偏差（极坐标）
keys-workspace-in-3-d = 三维工作空间
keys-fit-the-plots-view = 使图适合窗口
keys-the-same = 同上
keys-first-step = 第一步
keys-second-step = 第二步
keys-third-step = 第三步
keys-fourth-step = 第四步
keys-fifth-step-where-there-are = 第五步（有区域时）
keys-about-truepose = 关于 truepose
keys-glossary = 术语表
keys-this-list = 本列表
keys-all-commands-by-a-word = 按名称查找所有命令
keys-move-the-boundary-that-has = 移动获得焦点的边界
keys-move-it-further = 移动更多
keys-orbit-and-zoom-the-3 = 旋转和缩放获得焦点的三维视图
keys-next-control-the-one-before = 下一个、上一个控件
keys-space-or-enter = 空格键或 Enter
keys-press = 按下
keys-larger-smaller-usual-text = 放大、缩小、恢复文字大小
keys-close-a-sheet = 关闭对话框
keys-the-mouse-in-the-plots = 在图中使用鼠标

## over

over-no-sample-has-a-joint = 没有样本带关节值
over-every-sample-needs-its-q1 = 每个样本都需要 q1 单元格
over-no-time-was-logged = 未记录时间
over-a-column-time-s-would = 有 time_s 列即可看出偏差在测量中是否漂移，以及何时有人碰过三脚架
over-no-load-was-logged = 未记录负载
over-a-column-load-kg-would = 有 load_kg 列即可看出手臂在负载下是否变形：请对一些位姿分别空载和加载测量
over-no-temperature-was-logged = 未记录温度
over-a-column-temperature-c-would = 有 temperature_c 列即可看出偏差是否随机器温度变化
over-the-joints-motion-was-not = 未记录关节运动
over-columns-speed1-deg-s = 有 speed1_deg_s 和 dir1 列即可看出偏差如何随运动变化
over-time-since-the-first-sample = 自第一个样本起的时间
over-speed-of = { $joint } 的速度
over-travel-of-since-it-reversed = { $joint } 换向后的行程

## by-joint

by-joint-deviation-by-joint = 各关节的偏差
by-joint-the-deviation-over-every-joint = 偏差对每个关节的分布，各从最小值到最大值。某一格中出现曲线，就是该关节的误差
by-joint-every-sample-needs-its-joint = 每个样本都需要关节值和测量值
by-joint-no-sample-to-show = 没有可显示的样本
by-joint-each-over-the-range = 关节，各在所示范围内
by-joint-deviation-by-joint-2 = 各关节的{ $name }偏差
by-joint-deviation-by-joint-3 = 各关节的偏差，{ $name }
by-joint-deviation-of-samples-over-joints = { $samples } 个样本的{ $name }偏差，{ $joints } 个关节，{ $from } 至 { $to }

## correction

correction-correction-table = 修正表
correction-this-format-describes-the-robot = 该格式描述机器人本身，没有表格
correction-correction-table-as-a-curve = 修正表曲线
correction-the-same-for-both-directions = 两个方向相同
correction-solid-moving-positive-dashed-moving = 实线：正向运动 · 虚线：负向运动
correction-correction-table-2 = 修正表
correction-correction = 修正量，{ $unit }

## deviation

deviation-angle = 角度
deviation-deviation-over-angle = 偏差-角度
deviation-deviation-over-time = 偏差-时间
deviation-deviation-over-load = 偏差-负载
deviation-deviation-over-temperature = 偏差-温度
deviation-deviation-chart = 偏差图，{ $component }
deviation-chart = { $chart }图，{ $component }
deviation-deviation-over = { $name }偏差-{ $label }
deviation-to = { $component }，相对 { $first }
deviation-the-never-changes = { $what }从不变化
deviation-from-the-smallest = 每列从最小值到最大值
deviation-one-sample-has-no-value = 一个样本没有值，未显示
deviation-samples-have-no-value = { $n } 个样本没有值，未显示
deviation-to-2 = { $from } 至 { $to }
deviation-no-sample-to-show = 没有可显示的样本
deviation-deviation-of-samples-over = { $samples } 个样本的{ $component }偏差，{ $label }从 { $from } 到 { $to }
deviation-tolerance = ，公差 { $tolerance }

## curve

curve-effects-own-curve = 效应曲线
curve-curve = { $curve }的曲线，{ $component }
curve-there-is-no-curve = 没有可显示的曲线
curve-run-the-diagnosis-again-what = 请重新运行诊断：所发现的属于其他样本
curve-without = 不含{ $what }
curve-what-it-does = 其作用
curve-residual-without-and-what = 不含{ $what }的{ $component }残差及其作用
curve-what-is-left-without-all = 不含{ $curve }时的剩余；其余按拟合值
curve-it-depends-on-the-pose = 还取决于位姿：各样本处的值
curve-a-set-up-error = 安装错误尚未改正，也显示在此
curve-over-it-moves-the-deviation = { $curve }-{ $label }：使{ $component }偏差移动 { $from } 至 { $to }；不含它时均方根剩余 { $before }，含它时 { $after }

## chart-gap

chart-gap = 误差
chart-gap-by-step = 逐步误差
chart-gap-nothing-is-identified-yet = 尚未辨识
chart-gap-rms-over-the-fitted-samples = 拟合样本的 RMS
chart-gap-by-step-2 = 逐步误差：{ $steps }

## histogram

histogram-bars-as-wide-as = 条宽由样本的离散程度决定
histogram-histogram = 直方图
histogram-histogram-2 = 直方图
histogram-histogram-3 = 直方图，{ $component }
histogram-no-sample-can-be-counted = 没有可计数的样本
histogram-every-sample-lacks-a-joint = 每个样本都缺少关节值或坐标
histogram-click = 单击
histogram-marks-them = 标记这些样本
histogram-tolerance = {" "}公差{" "}
histogram-samples-by-deviation = 按{ $name }偏差统计的样本
histogram-deviation = { $name }偏差，{ $units }
histogram-within = { $sign }{ $tolerance } 以内：{ $counts } / { $all }
histogram-one-lies-beyond-the-ends = 有一个在两端之外
histogram-lie-beyond-the-ends = 有 { $n } 个在两端之外
histogram-wide = 宽 { $width } { $unit }，{ $rule }
histogram-most = 最多 { $bin } 个，从 { $from } 到 { $to }
histogram-how-many-samples-have-which = 各{ $component }偏差的样本数

## orders

orders-orders = 阶次
orders-order-spectrum = 阶次谱
orders-order-spectrum-2 = 阶次谱，{ $component }
orders-orders-are-cycles-per-turn = 阶次是每转的周期数。请选择一个旋转关节
orders-slides = { $name } 是移动关节
orders-too-few-different-angles = 不同的角度太少
orders-an-order-shows-where = 阶次显示每转重复出现的波动：请在关节全范围内测量三十个以上的角度
orders-usual-cause = 常见原因
orders-noise = 噪声，{ $name }
orders-order = { $order } 阶
orders-deviation-by-order-over = { $joint } 的{ $name }偏差阶次
orders-cycles-per-turn = { $joint } 每转的周期数
orders-amplitude = 幅值，{ $unit }
orders-too-few-samples-to-say = 样本太少，无法判断噪声
orders-order-2 = { $order } 阶{ $cause }，{ $amplitude }
orders-nothing-above-the-noise = 没有高于噪声的成分
orders-orders-of-the-deviation-before = { $component }偏差的 { $orders } 个阶次；校正前：{ $before }
orders-after = ；校正后：{ $after }
orders-noise-stays-below-the-line = 100 次测量中有 99 次噪声低于该线
orders-range-orders-nearer-than-cannot = 范围 { $range }°：相距小于 { $apart } 的阶次无法区分
orders-and-order-1-cannot-be = ，且看不到 1 阶
orders-and-orders-up-to-cannot = ，且看不到 { $n } 阶以下
orders-eccentricity = 偏心
orders-two-cycle = 二次谐波
orders-gear = 齿轮

## quantiles

quantiles-quantiles = 分位数
quantiles-normal-quantiles = 正态分位数
quantiles-each-samples-residual-over = 每个样本的残差相对于纯噪声下应处的位置。落在直线上即只有噪声；两端偏离是异常值，中部的弯折或台阶是模型缺少的误差
quantiles-nothing-to-compare = 没有可与正态分布比较的数据
quantiles-choose-a-component-that-has = 请选择带符号的分量，至少四个样本
quantiles-normal-quantiles-2 = 正态分位数，{ $name }
quantiles-residuals-of-samples-over-normal = { $samples } 个样本的{ $name }残差-正态分位数；中间一半的离散相当于 { $sigma } 的噪声
quantiles-residuals-over-normal-quantiles = { $name }残差-正态分位数
quantiles-what-noise-alone-would-be = 仅有噪声时的值，σ
quantiles-the-line-has-the-slope = 直线斜率为 σ = { $sigma }

## boundary-entry

boundary-entry-milliradians = 毫弧度
boundary-entry-seconds-of-arc = 角秒
boundary-entry-the-angle-is-missing-type = 缺少角度；请以{ $name }输入，例如 { $example }
boundary-entry-is-no-angle-type = “{ $text }”不是角度；请输入以{ $name }为单位的数，例如 { $example }
boundary-entry-a-boundary-is-an-angle = 边界是一个角度；请输入数字
boundary-entry-is-outside-of-the-joints = { $at } 超出关节范围 { $range }；{ $same } 是同一方向：请输入它
boundary-entry-is-outside-of-the-joints-range = { $at } 超出关节范围 { $range }；请输入范围内的角度
boundary-entry-at-most = 至多 { $from }
boundary-entry-at-least = 至少 { $to }
boundary-entry-region-would-overlap-region-type = 区域 { $next } 会与区域 { $other } 重叠，{ $from } … { $to }；请输入{ $free }，或合并两者
boundary-entry-type-or-more = 请输入 { $least } 或更大
boundary-entry-type-or-less = 请输入 { $most } 或更小
boundary-entry-region-would-begin-and-end = 区域 { $name } 的起点和终点都在 { $from }；{ $instead }
boundary-entry-region-would-be-wide-less = 区域 { $name } 宽 { $width }，小于 { $least }；{ $instead }
boundary-entry-region-would-run-from-over = 区域 { $name } 会从 { $from } 越过 { $limit } 到 { $to }；区域不允许如此：请分成两个，一个到 { $first }，一个从 { $second } 开始
boundary-entry-region-would-begin-at-after = 区域 { $name } 的起点 { $from } 在终点 { $to } 之后；{ $instead }

## compensated

compensated-neither-its-ending-nor-its = { $path }：扩展名和内容都无法说明其类型；应为 { $all }

## division

division-one-region-nowhere-does = 一个区域：偏差的变化处处不超过噪声
division-regions-a-boundary-where = { $n } 个区域：在偏差变化超过噪声处设边界
division-they-leave-even-ones = { $first }。剩余 { $left }，{ $n } 个均匀区域则剩余 { $even }

## edit

edit-nothing-was-measured-yet-open = 尚无测量：请打开在该机器人上的测量
edit-regions-are-for-a-single = 区域仅用于单个旋转关节
edit-a-tolerance-is-a-number = 公差须为大于 0 的数
edit-a-table-needs-a-joint = 表格需要机器人的一个关节和大于 0 的步长
edit-there-is-no-such-effect = 没有这个效应
edit-no-sample-would-be-left = 将没有样本可供拟合
edit-no-sample-would-be-left-2 = 将没有样本
edit-open-session = 打开测量
edit-open-model = 打开模型
edit-divide-into-regions = 划分区域
edit-move-boundary = 移动边界
edit-divide-adaptively = 自适应划分
edit-keep-the-regions = 保留区域
edit-split-region = 拆分区域
edit-merge-regions = 合并区域
edit-delete-region = 删除区域
edit-rename-region = 重命名区域
edit-take-regions-from-session = 采用测量中的区域
edit-choose-method = 选择方法
edit-choose-effects = 选择效应
edit-set-tolerance = 设置公差
edit-choose-table = 选择表格
edit-add-to-model = 加入模型
edit-switch-effect = 启用效应
edit-switch-effect-off = 停用效应
edit-edit-robot-and-instrument = 编辑机器人和仪器
edit-exclude-samples = 排除样本
edit-include-samples = 纳入样本
edit-mend-data = 更正数据
edit-restore = 恢复
edit-the-boundary-cannot-be-moved = 边界不能移到那里
edit-the-region-is-too-narrow = 该区域太窄，无法拆分
edit-no-region-begins-where-this = 没有区域从此区域的终点开始；请先在下一个区域输入终点
edit-the-last-region-stays-without = 保留最后一个区域：没有区域就无法修正
edit-a-region-needs-a-name = 区域需要名称
edit-another-region-is-called-choose = 已有名为 { $name } 的区域；请另选名称

## loaded-session

loaded-session-length = 长度
loaded-session-tangential = 切向
loaded-session-radial = 径向
loaded-session-axial = 轴向

## search

search-set-up-errors = 安装错误
search-noise-outliers-candidates = 噪声、异常值、候选
search-search = 搜索
search-other-explanations = 其他解释
search-poses-to-measure-next = 接下来要测的位姿
search-the-search-was-cancelled = 搜索已取消

## setup

setup-a-joint-needs-a-name = 关节需要名称
setup-another-joint-is-called = 已有名为 { $form } 的关节
setup-the-noise-is-a-number = 噪声须为大于 0 的数
setup-a-reflector-needs-a-name = 反射靶需要名称
setup-another-reflector-is-called = 已有名为 { $name } 的反射靶
setup-limits-run-from-the-smaller = 限位须从较小值到较大值
setup-a-mass-is-0-kg = 质量须为 0 kg 或以上
setup-robot-and-instrument = 机器人和仪器
setup-joint = 关节 { $k }，{ $joints }
setup-tool-and-gravity = 工具和重力
setup-reflectors = 反射靶
setup-not-taken-over-while-something = 有错误时不会采用
setup-back-to-what-was-there = 恢复原状
setup-name-of-joint = 关节 { $n } 的名称
setup-turns = 旋转
setup-slides = 移动
setup-axis-direction-at-home = 轴线，零位时的方向
setup-axis = 轴线 { $n }
setup-a-point-on-it-mm = 轴线上一点，mm
setup-point = 点 { $n }
setup-limits-of-joint = 关节 { $n } 的限位，{ $unit }
setup-limit = 限位 { $n }
setup-mass-of-link-kg = 连杆 { $n } 的质量，kg
setup-mass = 质量 { $n }
setup-its-centre-at-home-mm = 零位时的质心，mm
setup-centre = 质心 { $n }
setup-tool-at-home-mm = 零位时的工具，mm
setup-orientation-quaternion-w-x-y = 姿态，四元数 w x y z
setup-orientation = 姿态
setup-gravity-is-known-m-s = 重力已知，m/s²
setup-gravity = 重力
setup-in-the-tool-frame-mm = 工具坐标系中，mm
setup-name-of-reflector = 反射靶 { $n } 的名称
setup-reflector = 反射靶 { $n }
setup-remove-this-reflector = 移除此反射靶
setup-add-a-reflector = 添加反射靶
setup-name-of-the-instrument = 仪器名称
setup-noise-one-mm = 噪声，一倍 σ，mm
setup-unknown = 未知
setup-one-number = 一个数
setup-noise = 噪声

## simulation

simulation-nominal-radius = 名义半径
simulation-zero-offset = 零位偏移
simulation-length-error = 长度误差
simulation-this-field-needs-a-number = 此处需要数字
simulation-the-radius-has-to-be = 半径须大于 0 mm
simulation-the-tolerance-cannot-be-below = 公差不能小于 0
simulation-the-sweep-has-to-run = 扫描须从较小角度到较大角度
simulation-the-step-has-to-be = 步长须大于 0°
simulation-that-is-more-than = 位姿超过一百万个；请增大步长
simulation-the-noise-cannot-be-below = 噪声不能小于 0
simulation-every-field-needs-a-number = 每一处都需要数字
simulation-new-by-simulation = 通过仿真新建
simulation-a-lamp-on-one-turning = 一台绕单轴旋转的灯具，由跟踪仪测量。这里填写的就是辨识应当找到的
simulation-what-stands-in-colour-above = 请先更改上面彩色显示的数值
simulation-simulate = 仿真
simulation-robot = 机器人
simulation-tolerance = 公差
simulation-sweep = 扫描
simulation-there-and-back = 往返
simulation-seed = 随机种子
simulation-other-effects = 其他效应
simulation-remove = 移除
simulation-add-an-effect = 添加效应…
simulation-add-an-effect-2 = 添加效应

## about

about-calibrates-a-robot-at-commissioning = 在调试时标定机器人：找出测量与仿真不一致之处，并写出控制器所需的数据
about-everything-in-this-window-can = 此窗口的一切操作也可在终端完成：truepose --help
about-type-inter-by-the-inter = 字体：Inter，Inter 项目作者，SIL Open Font License 1.1
about-version = 版本 { $version }

## compensation

compensation-compensate = 补偿 { $name }
compensation-save-corrected-file = 保存修正后的文件…
compensation-load-where-the-file-says = 文件未给出时的负载
compensation-the-measuring-frame = 测量坐标系即机器人基座 (--measured-frame)
compensation-tool-of-the-program = 程序的工具
compensation-frame-of-the-program = 程序的坐标系
compensation-as-modelled = 即模型的 (--as-modelled)
compensation-as-programmed = 按程序所写 (--as-programmed)
compensation-read-as = 读作
compensation-of = { $corrected } / { $targets }
compensation-targets-corrected = 已修正的目标点
compensation-rms-position-error = RMS 位置误差
compensation-largest-position-error = 最大位置误差
compensation-lines-that-change = 更改的行
compensation-line = 行
compensation-is-left-as = { $name } 保持不变：{ $left }
compensation-not-corrected = 未修正：{ $says }
compensation-line-column = 第 { $line } 行第 { $column } 列：{ $says }
compensation-and-more-all-of-them = 以及另外 { $more } 项：全部列在所保存文件旁的文件中

## import

import-more-options = 此类文件的更多选项
import-not-imported = 不导入
import-point-name = 点名
import-group-of-points = 点组
import-reflector = 反射靶
import-unit-as-chosen = { $axis }，按所选单位
import-joint-commanded = 关节 { $n } 指令值，{ $sign }
import-joint-read-back = 关节 { $n } 回读值，{ $sign }
import-side-joint-came = 关节 { $n } 的趋近方向
import-speed-of-joint-s = 关节 { $n } 的速度，°/s
import-load-kg = 负载，kg
import-temperature-c = 温度，°C
import-time-s = 时间，s
import-setup-of-the-instrument = 仪器测站
import-fit-held-out-or-excluded = 拟合、留出或排除
import-orientation = 姿态 { $part }
import-as-you-said = 按您的指定
import-for-certain = 确定
import-guessed-from-the-header = 由表头推测
import-guessed-from-the-values = 由数值推测
import-columns-what-each-is-how = 列：含义、依据、表头、前几行
import-before-the-table = 表格之前：{ $lines }
import-of-columns-are-guessed-compare = { $columns } 列中有 { $guesses } 列是推测的：请与前几行核对
import-the-columns-are-right = 列正确
import-meaning-of-column = 第 { $k } 列的含义
import-where-the-robot-was-sent = 机器人的指令位置（表格中没有时）
import-file-of-the-commands = 指令文件
import-a-table-with-q1-deg = 含 q1_deg, … 以及可能的 name, time_s, dir1, load_kg 的表格
import-by-order = 按顺序
import-by-name = 按名称
import-by-time = 按时间
import-matched = 匹配
import-as-it-suits = 自动
import-the-mean-of-each-stop = 每次停留的均值
import-all = 全部
import-samples-are = 样本为
import-clocks-apart = 时钟偏差
import-found-from-the-motion = 由运动求得
import-typed = 输入
import-seconds-to-add = 测量时间要加的秒数
import-the-measured-clock-needs-s = 测量时钟需加 { $offset_s } s 才与指令一致，± { $sigma } s (95 %)；剩余 { $rms } mm
import-with-s-added-mm-are = 加 { $offset_s } s 后，路径与测量之间剩余 { $rms } mm
import-points-known-in-the-base = 基座坐标系中的已知点（仪器有自己的坐标系时）
import-file-of-the-known-points = 已知点文件
import-a-table-with-name-x = 含 name, x_mm, y_mm, z_mm 的表格；名称与测量文件相同
import-fit-a-scale-too = 同时拟合比例
import-points-fit-with-mm-root = { $used } 个点拟合到 { $rms } mm（均方根）
import-excluded-measured-or-surveyed-wrongly = ，排除 { $left_out } 个：测量有误，或之后被移动
import-scaled-by-ppm = 比例 { $scale } ({ $ppm } ppm)
import-point = 点
import-off-by-mm = 残差，mm
import-in-x = x 向
import-in-y = y 向
import-in-z = z 向
import-reflectors-in-the-tool-frame = 工具坐标系中的反射靶（有多个时）
import-file-of-the-reflectors = 反射靶文件
import-a-table-with-name-x-mm = 含 name, x_mm, y_mm, z_mm 的表格；没有则在工具原点有一个
import-rows = { $rows } 行
import-separated = 以{ $separator }分隔
import-header-in-line = 表头在第 { $line } 行
import-no-header = 无表头
import-unit = 单位：{ $found }
import-name-of-the-session = 测量名称
import-source = 来源
import-what-wrote-the-file = 写出文件的程序
import-commas = 逗号
import-semicolons = 分号
import-tabs = 制表符
import-spaces = 空格
import-separated-2 = 分隔符
import-header = 表头
import-as-the-headings-say = 按表头
import-angles = 角度单位
import-as-the-file-says = 按文件
import-inches = 英寸
import-y-points-up-turn = y 轴朝上：旋转使 z 轴朝上
import-joint-measured = 被测关节
import-as-found = 按检测结果
import-in-line = 所在行
import-line-of-the-header = 表头所在行
import-take = 选取
import-choose-it-in-the-table = 请在上面的表格中选择
import-it = 是{ $answer }
import-import = 导入 { $name }
import-import-2 = 导入
import-looking-at-the-file-was = 查看文件已取消
import-look-again = 重新查看
import-stop-looking = 停止查看
import-warning = 警告：
import-error = 错误：
import-choose = 选择…
import-choose-2 = 选择：{ $label }
import-use-which-lies-beside = 使用旁边的 { $file }
import-taken-by-its-name = 名称与该文件一致，已自动采用
import-use = 使用 { $file }：{ $label }
import-what-the-import-brings = 导入的内容
import-to-fix = 待解决
import-mm-from-the-nominal-robot = ，与名义机器人相差 { $rms } mm
import-matched-by-unmatched-measured-commanded = ；按 { $id } 匹配；未匹配：实测 { $lonely_measurements }，指令 { $lonely_commands }
import-that-of-the-open-session = 当前测量的机器人，{ $here }
import-that-of-the-example = 示例“{ $example }”的机器人
import-the-one-in-this-file = 此文件中的机器人
import-file-of-the-robot = 机器人文件
import-a-robot-a-session-or = 机器人、测量或 URDF 文件
import-base = 基座
import-link-of-the-base = 基座连杆
import-tip = 末端
import-link-of-the-tool = 工具连杆
import-name-of-a-link = 连杆名称
import-one-axis-that-turns-typed = 一个旋转轴，在此输入
import-name = 名称
import-name-of-the-robot = 机器人名称
import-axis-at-home = 零位时的轴线
import-axis = 轴线
import-point-on-it-mm = 轴线上一点，mm
import-point-2 = 点
import-tool-at-home-mm = 零位工具，mm
import-travel = 行程，°
import-travel-2 = 行程
import-gravity-points-along-z = 重力沿 −z
import-one-joint-that-turns = 一个旋转关节
import-one-joint-that-slides = 一个移动关节
import-joints-of-which-turn = { $count } 个关节，其中 { $turns } 个旋转
import-tool-mm-from-the-base = { $robot }：{ $joints }，工具距基座 { $reach } mm
import-looking-at-the-file = 正在查看文件…
import-a-table-of-at-most = 最多 1000 MB 的表格：请减少导出的点，或拆分文件
import-answer-what-is-asked-above = 请先回答上面的问题
import-the-file-cannot-be-read = 无法这样读取文件
import-look-at-the-columns-above = 请核对并确认上面的列
import-give-the-session-a-name = 请给测量命名
import-say-whose-robot-was-measured = 请指明测量的是哪台机器人
import-say-which-file-the-robot = 请指明机器人所在的文件
import-the-robot-cannot-be-read = 无法这样读取机器人
import-the-travel-runs = 行程须从较小值到较大值
import-the-tool-lies = 工具位于轴线上：请指明零位时它偏离轴线的位置
import-a-robot-needs-a-name = 机器人需要名称
import-and-more = 以及另外 { $more } 项
import-clocks-apart-2 = “时钟偏差”
import-matched-by-order-or = “匹配”按顺序或名称
import-matched-by-name-or = “匹配”按名称或时间
import-matched-by-order = “匹配”按顺序
import-matched-2 = “匹配”
import-samples-are-all = “样本为”全部
import-samples-are-2 = “样本为”
import-a-file-of-commands = 指令文件，含
import-a-file-of-commands-2 = 指令文件
import-a-file-of-reflectors = 反射靶文件，含
import-a-file-of-known-points = 已知点文件
import-angles-2 = “角度单位”
import-separated-3 = “分隔符”
import-decimal-sign = “小数点”
import-the-columns-above-as = 上面的列作为
import-y-points-up = “y 轴朝上”
import-fit-a-scale = “拟合比例”
import-joint-measured-2 = “被测关节”
import-lengths = “长度单位”

## palette

palette-what-to-do = 要做什么
palette-command = 命令
palette-no-command-has-this = 没有名称含此内容的命令

## path

path-the-samples-are-written-beside = 样本写入旁边同名的 CSV 文件
path-path-to-save = 保存路径
path-in-the-folder = { $name }，在文件夹 { $folder } 中
path-replace-the-file-if = 文件已存在时替换
path-save = 保存
path-a-file-that-says-what = 旁边会写入一个说明表格含义的文件
path-the-model-can-be-exported = 模型以后可以导出和验证
path-a-csv-table = CSV 表格，列名与测量相同，供接下来测量
path-a-name-that-ends = 以 .html 或 .pdf 结尾的名称；尚未诊断的测量会先进行诊断
path-a-name-that-ends-in-svg-or-png = 以 .svg 或 .png 结尾的名称
path-what-was-changed-is-written = 更改内容写入旁边的 NAME.meta.json

## preferences

preferences-preferences = 首选项
preferences-inch = 英寸
preferences-angles = 角度单位
preferences-readable = 自动
preferences-decimals-of-lengths = 长度小数位
preferences-as-the-system = 跟随系统
preferences-light = 浅色
preferences-dark = 深色
preferences-colours = 颜色
preferences-size-of-text = 文字大小
preferences-files-are-read-and-written = 无论此处如何显示，文件都按其自身单位读写
preferences-reset-all = 全部重置
preferences-language = 语言

## recovery

recovery-not-saved-when-the-program = 程序结束时未保存
recovery-the-last-time-the-program = 上次程序意外结束。只要不在此丢弃，就不会丢失：现在不恢复的，下次仍会提供
recovery-a-file-that-is-damaged = 已损坏的文件
recovery-kept = 保存于
recovery-its-file = 文件
recovery-discard = 丢弃
recovery-restore = 恢复
recovery-put-it-aside = 另行存放
recovery-discard-all = 全部丢弃
recovery-discard-all-for-good = 永久丢弃全部 { $count } 个
recovery-not-now = 以后再说
recovery-less-than-a-minute-ago = 不到一分钟前
recovery-its-first-line-is-not = 首行不完整
recovery-its-first-line-cannot-be = 首行无法读取
recovery-expected-the-format = 应为格式 { $format }
recovery-of-bytes-are-there = { $bytes } 字节中只有 { $document } 字节
recovery-its-contents-do-not-agree = 内容与其哈希值不符
recovery-minutes-ago = { $count } 分钟前
recovery-hours-ago = { $count } 小时前
recovery-days-ago = { $count } 天前

## unsaved

unsaved-leave-without-saving = 不保存就退出？
unsaved-leave-without-saving-2 = 不保存退出
unsaved-open-without-saving = 不保存就打开？
unsaved-open-without-saving-2 = 不保存并打开
unsaved-simulate-without-saving = 不保存就仿真？
unsaved-simulate-without-saving-2 = 不保存并仿真
unsaved-changes-of-are-not = { $name } 的更改尚未存入文件 { $file }
unsaved-the-session-is-in-no = 测量 { $name } 尚未存入文件
unsaved-what-was-identified = { $name } 的辨识结果尚未存入文件
unsaved-go = 继续
unsaved-replace-what-another-program-wrote = 替换其他程序写入的内容？
unsaved-changed-since-it-was-read = { $path } 在读取后已更改。在此保存会替换其中的内容
unsaved-save-under-another-name = 另存为…
unsaved-replace = 替换

## glossary

glossary-the-same-stands-beside = 鼠标停在数值名称上时也会显示同样的说明

## settings

settings-they-were-damaged-and-are = 已损坏，保存为 { $aside }
settings-is-damaged = { $path } 已损坏

## file

file-it-was-cancelled = 已取消
file-exists-already-allow-replacing = { $path } 已存在；请允许替换，或另选名称
file-is-a-folder-or = { $path } 是文件夹或设备，无法替换；请另选名称
file-the-disk-is-full-make = 磁盘已满：请腾出空间，或保存到其他磁盘
file-the-disk-can-only-be = 磁盘只读：请保存到其他磁盘
file-nothing-may-be-written-there = 没有写入权限：请保存到其他文件夹
file-the-folder-is-not-there = 文件夹不存在：请另选，或先创建
file-the-name-is-too-long = 名称太长，或含有不允许的字符：请另选名称
file-there-is-no-such-example = 没有这个示例
file-the-examples-are = 示例在“文件”菜单中
file-opened = 打开
file-expected-the-name = 应为 UTF-8 编码的文件名
file-exists-already-allow-replacing-it-or = { $there } 已存在；请允许替换，或另选名称
file-was-not-written = { $path } 未写入
file-what-was-there-before = 原有内容仍在
file-read = 读取
file-checking-samples = 正在检查 { $samples } 个样本
file-could-not-be-nothing-was = 无法{ $done } { $name }；未作任何更改
file-the-system-has-no-program = 系统中没有对应的程序
file-expected-a-file-name = 应为以 .svg 或 .png 结尾的文件名
file-the-diagnosis-was-run = 已为此运行诊断
file-some-letters-stand = 其中一些字符以代码表示：{ $says }
file-names-the-table-with-its = 列出表格 { $table } 及其哈希值
file-a-table-is-not-named = 其中未列出表格：{ $because }
file-could-not-be-saved = 无法保存 { $path }

## dialog

dialog-open-session-model-or-measurements = 打开测量、模型或测量数据
dialog-sessions-and-models-json = 测量和模型 (*.json)
dialog-all-files = 所有文件
dialog-targets-or-program-to-correct = 要修正的目标点或程序
dialog-import-measurements = 导入测量数据
dialog-where-the-robot-was-sent = 机器人的指令位置
dialog-points-known-in-the-base = 基座坐标系中的已知点
dialog-reflectors-in-the-tool-frame = 工具坐标系中的反射靶
dialog-robots-and-sessions-json-urdf = 机器人和测量 (*.json, *.urdf, *.xml)
dialog-tables-csv-txt-tsv-dat = 表格 (*.csv, *.txt, *.tsv, *.dat, *.asc)
dialog-measurements-csv-txt-tsv-dat = 测量数据 (*.csv, *.txt, *.tsv, *.dat, *.asc)
dialog-session-json = 测量 (*.json)
dialog-html-or-pdf-html-pdf = HTML 或 PDF (*.html, *.pdf)
dialog-pdf = PDF (*.pdf)
dialog-svg-or-png-picture = SVG 或 PNG 图片 (*.svg, *.png)
dialog-model-json = 模型 (*.json)
dialog-csv-table-csv = CSV 表格 (*.csv)
dialog-targets = 目标点
dialog-folder-with-the-sessions = 存放一台机器各次测量的文件夹
dialog-logo-of-the-report = 报告的徽标
dialog-png-pictures = PNG 图片

## running

running-cancelling = 正在取消

## gestures

gestures-wheel-or-pinch = 滚轮或双指缩放
gestures-zoom-at-the-pointer = 在指针处缩放
gestures-shift-and-wheel = Shift 加滚轮
gestures-zoom-along-a-charts-axis = 沿图的轴缩放
gestures-drag = 拖动
gestures-move = 移动
gestures-drag-with-the-right-button = 按右键拖动
gestures-show-a-part = 显示局部
gestures-drag-in-the-3-d = 在三维视图中拖动
gestures-orbit = 旋转视角
gestures-shift-or-middle-button = Shift 或中键加拖动（三维视图）
gestures-double-click-or-home = 双击或 Home
gestures-fit-the-view = 适合窗口

## legend

legend-show = 显示{ $name }
legend-leave-it-out-so = 隐藏，以便看清其余部分
legend-show-it-as-well = 同时显示
legend-as-measured = 实测
legend-legend = 图例
legend-nominal-path = 名义轨迹
legend-over-the-ranges = 关节范围内的位姿
legend-nominal-circle = 名义圆
legend-mean-before = 校正前均值
legend-mean-after = 校正后均值
legend-from-the-smallest = 每个角度从最小值到最大值

## plots

plots-save-picture = 保存{ $plot }的图片…
plot-workspace = 工作空间
plot-3-D-view = 三维视图
plot-polar = 极坐标图
plot-deviation = 偏差图
plot-deviation-over-time = 偏差-时间图
plot-deviation-over-load = 偏差-负载图
plot-deviation-over-temperature = 偏差-温度图
plot-deviation-by-joint = 各关节偏差图
plot-order-spectrum = 阶次谱
plot-histogram = 直方图
plot-normal-quantiles = 正态分位数图
plot-gap-by-step = 逐步误差图
plot-effect-s-curve = 效应曲线
plot-correction-table = 修正表

## camera

camera-isometric = 等轴测
camera-top = 俯视
camera-front = 前视
camera-side = 侧视
camera-view = { $view }视图
camera-seen-from-azimuth-elevation = 从方位角 { $azimuth }°、仰角 { $elevation }° 观察

## looking

looking-before-and-after = 校正前后
looking-uncertainty = 不确定度 (1σ)

## message

message-saved = 已保存 { $name }
message-there-is-nothing-to-search = 尚无可诊断的内容
message-open-a-session-that-was = 请打开在该机器人上的测量
message-the-model-from-a-file = 文件中的模型
message-the-identification-by-region = 按区域的辨识
message-identified-with-the-full-model = 已用完整模型辨识，代替{ $before }
message-the-diagnosis-starts = 诊断从完整模型开始；撤销可恢复之前的
message-identifying = 正在辨识，{ $samples }
message-preparing-the-table = 正在准备表格
message-drawing = 正在绘制
message-waiting-for-a-file = 等待选择文件
message-waiting-for-a-file-name = 等待文件名
message-could-not-be-opened = 无法打开 { $path }
message-something-went-wrong-inside = 程序内部出错
message-nothing-was-changed-save-your = 未作任何更改；请保存您的工作，并报告最后的操作
message-no-file-was-chosen = 没有选择文件
message-if-no-dialog-appeared-drop = 如果没有出现对话框，请把文件拖到窗口，或在“测量”步骤中输入路径
message-there-is-no-model = 没有可用于修正目标点的模型
message-identify-the-robot-first-or = 请先辨识机器人，或打开模型
message-correcting-the-targets = 正在修正 { $name } 的目标点
message-there-are-no-corrected-targets = 尚无修正后的目标点
message-choose-a-table-of-targets = 请先选择目标点表格或机器人程序
message-writing = 正在写入 { $path }
message-this-change-cannot-be-made = 无法进行此更改
message-regions-divide-what-was-measured = 区域用于划分单个旋转关节的测量
message-looking-where-regions-are-needed = 正在查找需要区域的位置
message-there-is-no-measuring-list = 尚无测量清单
message-run-the-diagnosis-first = 请先运行诊断
message-there-is-nothing-to-export = 尚无可导出的内容
message-there-is-no-file = 没有可跟踪的文件
message-the-samples-of-this-session = 此测量的样本没有单独的文件
message-the-file-was-rewritten = 文件已重写，正在重新读取
message-what-was-read-before = 之前读取的内容仍在；请改正文件，然后重新跟踪
message-the-file-cannot-be-followed = 无法继续跟踪该文件
message-looking-at-the-file = 正在查看文件
message-the-window-closes-after = 完成后关闭窗口：{ $what }
message-reading = 正在读取 { $path }
message-reading-an-example = 正在读取示例
message-simulating = 正在仿真
message-saving = 正在保存 { $path }
message-there-is-no-session = 没有可保存的测量
message-a-model-by-itself = 单独的模型在“导出”步骤中保存
message-there-is-nothing-to-report = 尚无可报告的内容
message-open-a-session-or-identify = 请先打开测量，或辨识机器人
message-the-figures-could-not-be = 无法计算这些指标
message-restored-it-is-not-saved = 已恢复；尚未保存
message-what-was-left-behind = 遗留的内容已损坏，无法恢复
message-it-is-kept-as = 已保存为 { $aside }
message-preferences-could-not-be-read = 无法读取首选项：{ $says }
message-what-is-not-saved-cannot = 未保存的内容无法防崩溃备份：{ $home }：{ $error }
message-not-everything-could-be-set = 有些内容无法设置
message-not-everything-could-be-kept = 有些内容无法保留
message-the-session-is-as = 测量保持原样；请另取名称保存
message-waiting-for-a-folder = 等待选择文件夹
message-comparing-the-sessions = 正在比较 { $folder } 中的各次测量
message-there-are-no-sessions = 没有可比较的测量
message-nothing-can-be-recorded = 无法记录
message-recorded = 已记录 { $path }：{ $says }
message-the-recording-ended = 记录已结束
message-what-was-recorded-before = 此前记录的内容在文件中

## view

view-regions = 区域
view-diagnose = 诊断

## chart

chart-component = 分量
chart-joint-of-the-chart = 图表的关节
chart-fit-chart-to-view = 图表适合窗口
chart-computing = 正在计算…

## compensate

compensate-compensate = 补偿…
compensate-a-table-of-targets-csv = 目标点表格 (CSV)、RAPID、KRL、URScript 或 FANUC LS：就地修正其中的目标点，保存前显示更改内容

## copies

copies-copied = 已复制
copies-copy = 复制
copies-table = { $says }表格：{ $of }
copies-copy-numbers = 复制数值：{ $of }

## coverage

coverage-rms-error-of-the-nominal = 名义机器人的 RMS 误差
coverage-largest-deviation = 最大偏差
coverage-of = { $inside } / { $all }
coverage-instrument = { $floor }，仪器
coverage-not-identified-yet-the-identified = 尚未辨识。辨识出的参数及每个数值的区间将显示在此
coverage-what-the-samples-cover = 样本覆盖范围
coverage-measured-range = 测量范围
coverage-widest-hole = 最大空缺
coverage-not-recorded = 未记录
coverage-took = 时长
coverage-throughout = 始终 { $decimals } { $unit }
coverage-samples-over-the-range = 关节 1 范围内的样本
coverage-samples-over-the-range-of-joint = 关节 1 范围内的样本：空白处一无所知
coverage-testable-effects = 可检验的效应
coverage-can-be-tested = { $yes } 个可检验
coverage-cannot-and-why = { $no } 个不可检验及原因
coverage-no-diagnosis-yet = 尚无诊断
coverage-effects-that-are-found-will = 发现的效应将列在此处，附大小、置信度和机器上应检查之处。样本无法判定时，两者都会列出，并附可判定的位姿
coverage-it-takes-a-moment = 需要片刻，一百万个样本需数秒。期间窗口可继续使用，搜索可随时停止
coverage-nothing-to-export-yet = 尚无可导出的内容
coverage-the-table-comes = 表格来自辨识后的机器人。它将以文本显示在此，附符号约定、剩余的 RMS 误差以及关节指令无法修正的部分
coverage-below-none-above = 自下 { $up }，自上 0
coverage-none-below-above = 自下 0，自上 { $down }
coverage-below-above = 自下 { $up }，自上 { $down }
coverage-standstill = 静止
coverage-throughout-2 = 始终 { $speed }
coverage-up = 最高 { $speed }
coverage-came-from = 趋近方向
coverage-came-from-joint = 趋近方向，关节 { $joint }
coverage-speed = 速度
coverage-speed-joint = 速度，关节 { $joint }

## disk

disk-was-changed-by-another-program = { $name } 已被其他程序更改
disk-reload-reads-it-again-undo = “重新加载”会再次读取；撤销可恢复当前内容。如保留此版本，覆盖前会询问您
disk-what-was-read-is-here = 已读取的内容仍在：保存会重新写入，或请放回文件
disk-keep-this = 保留此版本
disk-reload = 重新加载
disk-save-it-again = 重新保存
disk-save-it-again-2 = 重新保存…

## dropped

dropped-drop-the-file-to-open = 松开以打开文件

## export

export-there-is-nothing-to-export = 尚无可导出的内容：表格来自辨识后的机器人
export-found-but-not = 已发现但未加入模型，因此未修正：{ $names }
export-add-it-to-the-model = 加入模型
export-add-all-to-the-model = 将全部 { $n } 个加入模型
export-report = 报告
export-html-or-pdf-what-was = HTML 或 PDF：测量内容、搜索结果、未决事项
export-html-or-pdf-the-session = HTML 或 PDF：会先为其诊断测量，需要一些时间
export-report-of-the-model = 模型报告…
export-format = 格式
export-the-table-is-being-prepared = 正在准备表格
export-entries = 条目
export-also = 其他
export-copy-text = 复制文本
export-custom-step = 自定义步长
export-rms-error-to-this-robot = 与此机器人的 RMS 误差
export-rms-error-left = 表格剩余的 RMS 误差
export-not-correctable-by-joint-commands = 无法通过关节指令修正
export-over-the-samples-noise = 针对样本：包含噪声以及表格不知道的负载和温度；模型本身的承诺见下
export-model-and-measurement = 模型与测量
export-the-model-says-that-more = 模型预测的剩余大于实测：它不是这台机器人
export-what-the-numbers-mean = 数值含义
export-and-more-lines = 以及另外 { $more } 行
export-go-to-identify = 前往辨识
export-save-as = 将{ $what }保存为 .{ $title }…
export-without-it = 不修正时

## found

found-p-chance-that-noise-alone = p { $sign } { $p }（仅噪声就呈现如此的概率）
found-more-than-1000 = 超过 1000
found-times-likelier-than-the-next = 可能性是下一个候选 { $next } 的 { $odds } 倍
found-cross-validated-rms-error = 交叉验证 RMS 误差
found-what-to-check = 检查事项
found-add-to-model = 加入模型
found-in-the-model = 在模型中
found-mend-all = 全部更正（{ $mends }）

## limits

limits-detection-limits-95 = 检出限：{ $number } (95 %)
limits-detection-limits = 检出限
limits-not-testable = 不可检验：{ $not_testable }

## diagnosis

diagnosis-diagnosis = 诊断
diagnosis-nothing-found-so-far = 目前未发现
diagnosis-found-so-far-a-likelier = 目前发现；可能被更可信的效应取代
diagnosis-diagnosis-is-running = 正在诊断
diagnosis-it-had-found-nothing-until = 此前未发现任何效应
diagnosis-found-until-then-not-yet = 此前发现，尚未与其他效应比较：请重新运行诊断以检验
diagnosis-diagnosis-stopped = 诊断已停止
diagnosis-found-effects = 发现的效应
diagnosis-nothing-is-missing = 没有缺失
diagnosis-explained-the-remaining-error = 已解释：剩余误差处于噪声下限
diagnosis-partly-explained-an-error = 部分解释：仍有未命名的误差
diagnosis-not-explained-by-any-effect = 没有效应能解释
diagnosis-from-repeats = 由重复测量得出
diagnosis-of-the-instrument = 仪器的
diagnosis-these-samples-can-show-no = 这些样本无法显示任何效应：未发现并不说明什么
diagnosis-the-samples-also-allow-another = 样本也允许另一种解释，见下
diagnosis-held-out = 留出：{ $how }
diagnosis-noise-stated = 噪声 σ，标称
diagnosis-noise-as-found = 噪声 σ，实得
diagnosis-slow-noise = 慢噪声：{ $slow }
diagnosis-the-samples-cannot-rule-out = 样本无法排除
diagnosis-instead = { $instead }，而非 { $explanation }
diagnosis-1-against = { $odds } : 1 不支持。{ $separate_by }
diagnosis-excluded-by-hand = 手动排除
diagnosis-excluded-outliers = 排除的异常值：{ $excluded } / { $all }
diagnosis-and-more = 以及另外 { $more } 个

## next

next-measure-these-poses-next = 接下来测量这些位姿
next-second-time-the-same-pose = 第二次：测过另一位姿后再测同一位姿，因噪声较大，一次不够
next-and-more-in-the-measuring = 以及测量清单中的另外 { $more } 个
next-poses = 位姿
next-save-measuring-list = 保存测量清单…

## diagnose

diagnose-open-a-session-that-was = 请先打开在该机器人上的测量
diagnose-looks-for-the-physical-effect = 寻找模型缺少的物理效应，并用搜索未见过的样本验证每个效应
diagnose-nominal-robot = 名义机器人
diagnose-with-found-effects = 含已发现的效应
diagnose-run-diagnosis-again = 重新运行诊断
diagnose-rms-error-so-far = 目前的 RMS 误差
diagnose-the-diagnosis-identifies-by-itself = 诊断会自行辨识：不必先做辨识
diagnose-little-error-is-left-above = 误差仅略高于仪器噪声。诊断会以检出限说明没有缺失之处
diagnose-more-error-is-left-than = 剩余误差大于噪声所能解释，或未给出噪声：诊断会说明是哪种情况
diagnose-the-diagnosis-starts = 诊断从完整模型开始，并取代当前的辨识。撤销可恢复
diagnose-what-it-can-find = 能发现什么
diagnose-why-the-others-are-not = 其余为何不可检验列在右侧，并附应测内容
diagnose-diagnosing = 正在诊断
diagnose-found-so-far = 目前发现
diagnose-so-far-a-likelier-name = 目前结果；可能被更可信的效应取代
diagnose-in-the-model = 在模型中
diagnose-use = 使用{ $effect }
diagnose-one-effect-in-the-model = 模型中有 1 个效应
diagnose-effects-in-the-model = 模型中有 { $on } 个效应
diagnose-nothing-is-missing = 没有缺失
diagnose-something-unexplained = 有未解释的误差
diagnose-one-effect-found = 发现 1 个效应
diagnose-effects-found = 发现 { $n } 个效应
diagnose-stop-the-search = 停止搜索

## grips

grips-steps = 步骤
grips-results = 结果

## identify

identify-model-from-a-file = 来自文件的模型
identify-by-region = 按区域
identify-parameters = 完整模型，{ $count } 个参数
identify-with-the-full-model = 完整模型
identify-the-model-in-takes = { $given } 中的模型取代辨识
identify-to-identify-the-robot-anew = 要重新辨识机器人，请打开在其上的测量
identify-identify-from-this-session = 由此测量辨识
identify-method = 方法
identify-full-model = 完整模型
identify-by-region-2 = 按区域
identify-one-model-for-the-whole = 整个范围用一个模型，在测量坐标系中拟合，每个数值都有区间
identify-the-source-papers-method = 论文的方法：每个区域对角度和半径作常数修正。它忽略灯具与基座间的转动，因此同一常数误差在各区域表现不同；用于与以前的报告比较
identify-change-the-regions = 更改区域
identify-effects-to-fit = 要拟合的效应
identify-that-this-session-cannot-show = 此测量无法显示的 { $not_testable }
identify-identified-the-result-follows-every = 已辨识；结果随每次更改更新
identify-continue-to-diagnose = 继续：诊断

## menu

menu-examples = 示例
menu-not-there-any-more = 已不存在
menu-standard-3-d-views = 标准三维视图
menu-larger = 放大
menu-smaller = 缩小
menu-usual-size = 恢复大小
menu-file = 文件
menu-edit = 编辑
menu-view = 视图
menu-help = 帮助
menu-nothing-to-redo = 没有可重做的
menu-redo = 重做：{ $what }
menu-nothing-to-undo = 没有可撤销的
menu-undo = 撤销：{ $what }
menu-example = 示例
menu-simulated = 仿真
menu-restored = 已恢复
menu-from = 来自 { $path }
menu-model = 模型 { $origin }
menu-model-2 = { $origin } · 模型 { $given }
menu-not-saved = { $origin } · 未保存

## model

model-model-from-a-file = 来自文件的模型
model-file = 文件
model-identified = 辨识自
model-measured = 实测，{ $joint }
model-nothing-was-measured-yet-open = 尚无测量。请打开在该机器人上的测量，模型的效果将显示在此
model-how-it-came-about = 由来
model-held-out = { $gap }，留出 { $held_out }
model-held-against-this-session = 与此测量对比
model-measured-and-model = 测量与模型
model-with-corrected-commands = 使用修正后的指令
model-largest-then = 此时最大
model-the-largest-deviations-among-them = ，包括最大的偏差
model-of-samples = { $drawn } / { $samples } 个样本{ $largest }

## names

names-and = 和
names-not-identifiable = 无法辨识
names-show-its-curve = 显示曲线

## pictures

pictures-there-is-no-such-chart = 没有这个图表
pictures-the-deviation-around-the-angle = 沿角度的偏差
pictures-measured-points-deviations-magnified-times = 测量点，偏差放大 { $magnification } 倍

## regions

regions-from-to-and-where = { $regions }，从 { $low } 到 { $high }，以及样本位置
regions-region = 区域 { $name }，{ $from } … { $to }：{ $samples }
regions-in-no-region = 不在任何区域
regions-optional = 可选
regions-optional-2 = 可选，{ $regions }
regions-regions-divide-what-was-measured = 区域用于划分测量：请打开在该机器人上的测量
regions-uniform = 均匀
regions-manual = 手动
regions-adaptive = 自适应
regions-drag-a-boundary = 在图中拖动边界，或直接输入；辨识随即更新
regions-region-2 = {" "}个区域
regions-regions = {" "}个区域
regions-number-of-regions = 区域数
regions-divide = 划分
regions-reset-to-session = 恢复为测量的区域
regions-take-the-regions = 采用测量自带的区域
regions-there-are-no-regions-nothing = 没有区域：不会按区域修正。请均匀划分范围，或在数据需要处划分
regions-there-are-no-regions-because = 没有区域，因为所有样本都在同一角度：没有可划分的范围。请在“测量”中给出关节限位，或在其他角度测量。“辨识”中的完整模型不需要区域
regions-and-more = { $gap } 以及另外 { $n } 处
regions-in-no-region-and-no = { $more }：不在任何区域，且没有样本
regions-in-no-region-1-sample = { $more }：不在任何区域；其中 1 个样本得不到修正
regions-in-no-region-samples-there = { $more }：不在任何区域；其中 { $n } 个样本得不到修正
regions-sample = 个样本
regions-samples-are = 个样本
regions-in-no-region-and-get = { $outside } { $samples }不在任何区域，得不到修正
regions-optional-fills-the-next-step = 可选：逐区域填充下一步“辨识”
regions-identify-by-region = 按区域辨识
regions-split-in-half = 对半拆分
regions-it-is-too-narrow = 太窄
regions-merge-with-previous = 与前一个合并
regions-merge-with-next = 与后一个合并
regions-no-region-touches = 没有相邻区域
regions-delete = 删除
regions-the-last-region-stays = 最后一个区域须保留
regions-rename = 重命名
regions-change-region = 更改区域 { $name }
regions-with-the-focus-here-s = 焦点在此时：S 拆分，M 合并，Del 删除，R 重命名
regions-and-more-to-be-dragged = 以及另外 { $more } 个，可在图中拖动
regions-name = 名称
regions-from = 起，{ $unit }
regions-to = 止，{ $unit }
regions-no-sample-so-no-correction = 没有样本，因此没有修正：请在此测量，或与下一个合并
regions-none-of-which-can-be = { $measured }，均无法拟合，因此没有修正
regions-one-sample-to-fit = 只有一个可拟合的样本：有修正，但无法判断其不确定度
regions-name-of-region = 区域 { $name } 的名称
regions-region-3 = { $end }，区域 { $region }
regions-from-2 = 起点
regions-to-2 = 终点
regions-until-then-it-stays = { $which }{ $says }。在此之前保持 { $stays }
regions-show-the-sample-of-region = 显示区域 { $region } 的样本
regions-show-the-of-region = 显示区域 { $region } 的 { $samples }
regions-region-from = 区域 { $region }，起点：
regions-region-to = 区域 { $region }，终点：

## results

results-summary = 摘要
results-samples = 样本
results-this-could-not-be-identified = 无法辨识
results-rms-error-by-region = RMS 误差，按区域
results-rms-error-model = RMS 误差，来自文件的模型
results-rms-error-full-model = RMS 误差，完整模型
results-largest = 最大
results-of = { $before } → { $after } / { $all }
results-identified-parameters = 辨识的参数
results-half-the-95-interval = ± 95 % 区间的一半
results-parameters = 参数
results-correction-of-each-region = 各区域的修正
results-was = 原为 { $rms_before }
results-what-to-add = 应加的量
results-what-to-add-half = 应加的量，± 95 % 区间的一半
results-measurement-noise = 测量噪声：{ $noise }
results-excluded-outliers-of-samples = 排除的异常值：{ $excluded } / { $all } 个样本
results-sample-is-an-outlier = 样本 { $sample } 是异常值：与模型相差 { $deviation }
results-sample-is-excluded = 样本 { $sample } 已排除：{ $because }
results-and-more = 以及另外 { $more } 个
results-notes = 备注
results-region = 区域
results-no-decision = 无法判定：{ $because }

## samples

samples-sample = 样本
samples-angle = 角度，{ $angle }
samples-before = 校正前，{ $length }
samples-after = 校正后，{ $length }
samples-largest-first = ，从大到小
samples-smallest-first = ，从小到大
samples-column = 列 { $name }{ $order }
samples-excluded-by-hand-in-no = 手动排除，不计入任何指标
samples-row = 第 { $sample } 行，{ $what }
samples-within-the-tolerance = 在公差内
samples-outside-the-tolerance = 超出公差

## session

session-a-model-nothing-measured = 一个模型，无测量
session-measured = 测量内容
session-another-session-or-model = 其他测量或模型
session-none-this-is-a-model = 无：这是一个模型
session-reflectors = 反射靶
session-not-given = 未给出
session-noise-one = 噪声，一倍 σ
session-coordinates = 坐标
session-x-and-y-z-was = x 和 y；未测量 z
session-compensated = 已补偿
session-yes-this-shows-what = 是：此处显示的是剩余误差
session-new-lines-are-read-as = 新行一写入即读取，结果随之更新
session-came-since = 此后新增 { $samples }
session-import-log = 导入记录：{ $count }
session-note = 注意
session-warning = 警告
session-error = 错误
session-type-a-path-or-drop = 输入路径，或拖入文件
session-path-of-a-session-or = 测量或模型的路径
session-this-is-an-example = 这是程序自带的示例
session-continue-to-regions = 继续：区域

## standards

standards-accuracy-and-repeatability = 准确度与重复精度
standards-the-figures-are-being-worked = 正在计算指标
standards-figures = 指标
standards-missing = 缺少：{ $line }
standards-from-below-from-above = ↑ 自下，↓ 自上
standards-measured = 实测，{ $group }

## status

status-model-of-open-a-session = { $robot } 的模型 · 打开在该机器人上的测量即可查看模型效果
status-rms-error = RMS 误差 { $gaps } { $unit }
status-rms-error-2 = RMS 误差 { $rms } { $unit }
status-no-sample-can-be-used = 没有可用的样本
status-floor = {" "}· 下限 { $floor } { $unit }（{ $from }）
status-repeats = 重复测量
status-identify-again = 重新辨识
status-the-identification-was-cancelled = 辨识已取消
status-stop-following = 停止跟踪
status-following-the-file-new = 正在跟踪文件 · 新增 { $came }
status-understood = 知道了

## toast

toast-show-in-folder = 在文件夹中显示

## details

details-report-details = 报告信息
details-stated-at-the-head = 写在报告开头，并为这台机器保存；留空之处是供手工填写的一行
details-such-as-a-date = 例如 2026 年 11 月 22 日
details-field-report_number = 报告编号
details-field-date = 日期
details-field-customer = 客户
details-field-machine = 机器
details-field-machine_serial = 机器序列号
details-field-instrument = 测量仪器
details-field-instrument_serial = 测量仪器序列号
details-field-instrument_calibrated = 测量仪器校准日期
details-field-operator = 操作员
details-logo = 徽标
details-a-png-file = PNG 文件
details-history = 机器历史
details-compare-the-sessions = 比较该测量所在文件夹中此机器人的各次测量
details-save-the-session-first = 该测量尚未保存到文件夹：请先保存
details-logo-cannot-be-used = 徽标 { $found }；应为 { $expected }
details-pass-or-fail = 合格判定
details-last-time-it-was = 上次为 { $last } mm
details-use-it = 采用
details-decision-rule = 判定规则
details-not-decided = 不判定
details-simple-acceptance = 简单接受
details-the-reader-decides = 报告给出误差，由读者自行判定
details-pass-with-its-uncertainty = 最大偏差加其不确定度在公差内为合格；偏差不计不确定度即超出公差为不合格；介于两者之间则均未证实
details-pass-without-its-uncertainty = 最大偏差在公差内为合格；不确定度会给出，但不计入 (JCGM 106, 8.2)

## history

history-of = { $robot } 的历史
history-of-the-folder-by-time = 文件夹 { $folder } 中的测量和模型，按第一个样本的时间排列
history-of-the-folder-by-name = 文件夹 { $folder } 中的测量和模型，按文件名排列，其中的数字按数值
history-robot = 机器人
history-all-sessions = 所有测量
history-before-and-after = 前后对比
history-before = 之前
history-after = 之后
history-is-excluded = { $file } 已排除：{ $because }
history-other-folder = 其他文件夹…
history-errors = 误差
history-parameters = 参数
history-no-parameter-was-identified = 没有辨识出参数
history-half-the-95-interval = ± 95 % 区间的一半；{ $mark } 变化超过其区间
history-the-last-sessions = ；{ $all } 次测量中的最后 { $shown } 次
history-over-the-sessions = { $parameter }-各次测量
history-no-parameter-in-common = 它们没有共同的参数
history-parameters-changed = { $all } 个参数中有 { $changed } 个的变化超过差值的 95 % 区间
history-errors-before = 之前：RMS 误差，名义机器人 { $nominal }，辨识后 { $identified }
history-errors-after = 之后：RMS 误差，名义机器人 { $nominal }，辨识后 { $identified }
history-changed-of = { $changed } / { $all }
history-heading-session = 测量
history-heading-from = 来源
history-heading-samples = 样本
history-heading-rms-error-nominal-mm = 名义机器人的 RMS 误差，mm
history-heading-model-mm = 模型，mm
history-heading-with-the-earliest-mm = 用最早的模型，mm
history-heading-changed = 已变化
history-heading-parameter = 参数
history-heading-unit = 单位
history-heading-before = 之前
history-heading-after = 之后
history-heading-difference = 差值
history-heading-beyond-its-interval = 超出其区间
history-cell-session = 测量
history-cell-model = 模型
history-cell-not-determined = 未确定
history-cell-changed = 已变化
history-cell-no = 否

## recording

recording-record-from-instrument = 从测量仪器记录
recording-lines-of-text-become = 每行文本对应一个测得的点，成为 { $robot } 新测量的样本；连接中断后会重新建立
recording-address = 地址
recording-address-forms = tcp://HOST:PORT 或 udp://:PORT
recording-columns = 列
recording-empty-the-first-line = 留空：由第一行给出
recording-file = 文件
recording-a-new-csv-table = 新的 CSV 表格
recording-type-where-it-sends = 请输入测量仪器软件的发送地址，例如 tcp://192.168.0.10:4000
recording-columns-such-as = 列例如 q1_deg, x_mm, y_mm, z_mm；以逗号、分号、制表符或空格分隔
recording-a-name-that-ends-in-csv = { $path }：应为以 .csv 结尾的名称
recording-the-folder-is-not-there = { $folder }：文件夹不存在
recording-exists-already = { $path } 已存在：记录不会替换任何文件
recording-record = 记录
recording-stop = 停止记录
recording-left-out-last = 最近略去：{ $line }
recording-stands = 正在记录 · { $lines }{ $left_out } · { $state }
recording-lines = { $count } 行
recording-left-out = {" "}· 略去 { $count } 行
recording-connecting = 正在连接
recording-connected = 已连接
recording-not-connected = 未连接，正在重试：{ $why }

## unexplained

unexplained-unexplained = 未解释
unexplained-what-is-left = 剩余
unexplained-where = 位置
unexplained-a-part-of-it-looks = 其中一部分类似 { $resembles }
unexplained-it-cannot-be-corrected = 无法修正：{ $because }
unexplained-cross-validated-rms-error-corrected = 交叉验证 RMS 误差，修正后
unexplained-add-smooth-correction = 添加平滑修正
unexplained-smooth-correction-in-the-model = 模型中的平滑修正
unexplained-largest-along-the-motion = 沿运动方向最大
unexplained-largest-along-the-radius = 沿半径方向最大
unexplained-largest-along-the-axis = 沿轴向最大
unexplained-a-smooth-curve-without = 一条未命名的平滑曲线。测量范围之外保持端点值，且一无所知

## fields

fields-the-value-is-kept = { $because }；保持原值
fields-or-none = {""}，或无

## grip

grip-width = { $name }的宽度

## text

text-usually = 通常为 { $usual_size }
text-size-from-to = { $from } 至 { $to }
text-what-means = { $word }的含义

## sample

sample-before-after = 校正前 → 校正后
sample-moving-negative = 负向运动
sample-not-known = 未知
sample-approached = 趋近方向
sample-a-value-is-missing = 缺少一个值
sample-click-for-more = 单击查看更多
sample-card = { $title }的卡片：{ $parts }

## handles

handles-boundary = 边界 { $at }°
handles-drag-or-press-the-arrow = 拖动，或按方向键；按住 Shift 步长更大
handles-no-samples = { $name }：无样本
handles-l1-left = { $name }：{ $samples }，Δθ { $theta }，Δl1 { $l1 }，剩余 { $left }

## layout

layout-this-computer-draws-in-software = 本机使用软件绘图
layout-zoom-in-for-more = 放大可显示更多
layout-1 = 每 { $one_of } 个{ $what }显示 1 个：{ $why }
layout-points = 点

## paint

paint-workspace-plot-samples = 工作空间图，{ $samples } 个样本

## polar

polar-nothing-was-measured-yet = 尚无测量：极坐标视图显示沿关节角度的偏差
polar-this-robot-has-several-joints = 该机器人有多个关节，偏差不属于单一角度：没有极坐标视图。其他视图显示偏差的位置，下方图表显示其对应的第一关节值
polar-this-joint-slides = 这是移动关节，长度不构成圆：没有极坐标视图。下方图表显示沿关节行程的偏差
polar-1-division = 1 格 = { $length } { $unit }
polar-polar-view-samples = 极坐标视图，{ $component }，{ $samples } 个样本，{ $polar }
polar-deviation-around-the-angle = 沿角度的{ $component }偏差
polar-1-division-mm-the-thick = 1 格 = { $division } mm；粗圆为名义圆
polar-outline-before = 空心：校正前
polar-outline-before-filled-after = 空心：校正前，实心：校正后
polar-filled-after = 实心：校正后
polar-tip-up-moving-positive-tip = ；尖端朝上：正向运动，朝下：负向
polar-dashed-tolerance-mm = ；虚线：公差 { $tolerance } mm
polar-1-of-samples = ；每 { $stride } 个样本显示 1 个

## robot

robot-robot-at-sample = 样本 { $sample } 处的机器人
robot-robot-at-sample-as = 样本 { $sample } 处的机器人（示例）
robot-robot-as-posed = 按设定位姿的机器人
robot-robot-at-home = 零位的机器人
robot-and-more = 以及另外 { $more } 个

## scales

scales-legend = 图例：{ $name }

## pose

pose-pose = 位姿
pose-back-to-sample = 回到样本
pose-pose-of-joint = 关节 { $k } 的位置，{ $joint }
pose-from-the-sample = 取自所示样本

## space

space-3-d-view-samples = 三维视图，{ $samples } 个样本，{ $camera }
space-sample-selected = ，已选样本 { $sample }
space-arrow-keys-orbit-plus = 方向键旋转，加减键缩放，Home 适合窗口；0、1、3、7 为标准视图
space-grid = 网格 { $square } { $unit }
space-tool = 工具
space-samples-deviations-magnified-times = { $session }：{ $samples } 个样本，{ $camera }，{ $state }偏差放大 { $magnified } 倍
space-grid-mm = 网格 { $square } mm
space-colour = ；颜色：{ $colouring }
space-base = 基座

## toolbar

toolbar-fit-to-view = 适合窗口
toolbar-how-it-is-drawn = 绘制方式
toolbar-drawn = 显示
toolbar-vectors = 矢量 × { $now }
toolbar-length-of-vectors = 矢量长度
toolbar-3-d = 三维
toolbar-polar = 极坐标
toolbar-colour = 颜色
toolbar-component-of-the-polar-view = 极坐标视图的分量
toolbar-both = 两者
toolbar-only-after = 仅校正后
toolbar-from-before-to-after = 从校正前到校正后
toolbar-shown-the-deviation-before-measured = 显示：校正前的偏差，实测 − 名义机器人
toolbar-shown-what-is-left-after = 显示：校正后的剩余，实测 − 辨识后的机器人
toolbar-shown-of-the-way = 显示：从校正前到校正后的 { $percent } %
toolbar-how-long-vectors-are-drawn = 矢量的长度和长度颜色的上限：使校正前的偏差，或校正后剩余的偏差清晰可读
toolbar-scale = 比例
toolbar-free = 自由
toolbar-standard-view = 标准视图
toolbar-pose = 位姿
toolbar-sliders-that-pose-the-robot = 用滑块设定机器人位姿
toolbar-pose-the-robot = 设定机器人位姿
toolbar-the-root-mean-square-deviation = 样本之间的均方根偏差，离样本越远越淡
toolbar-colour-of-vectors = 矢量颜色
toolbar-from = 视角

## chart words

chart-word-before = 校正前
chart-word-after = 校正后
chart-word-as-measured = 实测
chart-word-against-the-model = 相对模型
chart-word-moving-positive = 正向运动
chart-word-negative = 负向
chart-word-tolerance = 公差
chart-word-noise-floor = 噪声下限
chart-word-cross-validated = 交叉验证
chart-word-on-samples-that-no-fit-has-seen = 未参与拟合的样本
chart-word-the-gap-step-by-step = 逐步误差
chart-word-rms-error = RMS 误差
chart-word-nominal-robot = 名义机器人
chart-word-geometry = 几何
chart-word-exact-identification = 完整模型
chart-word-full-model = 完整模型
chart-word-by-region = 按区域
chart-word-value-95-interval = 值，95 % 区间
chart-word-changed = 已变化
chart-word-by-the-time-of-the-first-sample = 按第一个样本的时间
chart-word-by-file-name-numbers-in-it-by-their-value = 按文件名，其中的数字按数值

## scale

scale-point = 点
scale-entry = 条目
scale-every-shown = 每 { $stride } 个{ $what }显示 1 个

## examples

example-lamp = 灯具调试
example-lamp-what = 两个反射靶，双向趋近，含噪声，机器升温过程中
example-samples = 论文的 30 个样本
example-samples-what = 六个区域，每个五个样本，无噪声
example-run = 论文的完整测量
example-run-what = 361 个样本，每半度一个

## effects

effect-on-joint = { $effect }，关节 { $joint }
effect-axis-tilt = 轴线倾斜
effect-axis-wobble = 轴线摆动
effect-backlash = 反向间隙
effect-base-offset = 基座偏移
effect-bearing-runout = 轴承跳动
effect-encoder-eccentricity = 编码器偏心
effect-encoder-two-cycle = 编码器二次谐波误差
effect-foundation-compliance = 基础柔度
effect-frame-drift = 测量坐标系漂移
effect-frame-shift = 测量坐标系突变
effect-gear-transmission-error = 齿轮传动误差
effect-instrument-scale = 仪器尺度误差
effect-joint-compliance = 关节柔度
effect-joint-scale = 关节比例误差
effect-joint-zero-offset = 关节零位偏移
effect-link-droop = 连杆下垂
effect-link-geometry = 连杆几何误差
effect-link-length = 连杆长度
effect-lost-motion = 空程
effect-measuring-frame = 测量坐标系
effect-screw-pitch = 丝杠螺距误差
effect-thermal-growth = 热膨胀
effect-thermal-zero-drift = 热零位漂移
effect-tool-lateral-offset = 工具侧向偏移
effect-tool-orientation = 工具姿态
effect-tool-position = 工具位置
effect-tracking-lag = 跟随滞后
effect-unexplained-directions = 未解释误差的方向
effect-unknown-anchor = 锚点
effect-unknown-plane = 平面
effect-unknown-socket = 靶座
effect-unknown-station = 测站
effect-wrist-coupling = 腕部耦合

## glossary words

word-deviation = 偏差
word-deviation-means = 反射靶的实测位置减去仿真给出的应有位置
word-gap = RMS 误差
word-gap-means = 所有样本偏差长度的均方根。疑似异常值不计入其中，但计入最大偏差
word-largest = 最大偏差
word-largest-means = 偏离最远的一个样本，包括疑似异常值
word-tolerance = 公差
word-tolerance-means = 实测位置允许的偏离量。公差内的样本标为圆点，公差外的标为菱形
word-noise = 噪声，一倍 σ
word-noise-means = 仪器读数本身沿一个轴的离散程度，取自厂家数据或重复性检查。三个读数中有两个小于此值。未给出时由样本估计
word-floor = 噪声下限
word-floor-means = 完美模型的 RMS 误差：重复位姿或仪器的离散。没有模型能低于它，接近它的模型已无可再解释
word-interval = 置信区间，±
word-interval-means = 在 20 次这样的标定中有 19 次真值落在其中。样本越多、位姿差异越大，区间越窄
word-held-out = 留出
word-held-out-means = 未参与任何拟合的样本。模型必须预测它们：在那里也下降的 RMS 误差是证据，只在其余样本上下降则是偶然
word-p-family = 偶然性
word-p-family-means = 仅噪声就使整个列表中某个效应看起来至少这么好的频率。2000 次中 1 次是有力证据，20 次中 1 次则不是
word-odds = 相对下一个候选的几率
word-odds-means = 根据样本，此效应比次优者可能多少倍。低于约 20 : 1 时两者都有可能，并列出可判定的位姿
word-share = 占比
word-share-means = 此效应解释了辨识剩余误差的多少
word-unexplained = 未解释
word-unexplained-means = 仍有规律性误差，列表中没有效应与之相符。会显示其位置，以便去那里检查
word-limit = 检出限
word-limit-means = 这些样本能够显示的效应的最小值。未发现的效应小于此值，但不一定为零
word-region = 区域
word-region-means = 关节的一段范围，有自己的常数修正，供较旧的控制器使用
word-correction = 修正量
word-correction-means = 应加到指令或位置上的量：符号相反的偏差
word-exact = 完整模型
word-exact-means = 整个范围用一个模型：在仪器坐标系中同时拟合所有参数
word-outlier = 疑似异常值
word-outlier-means = 离模型太远的样本，测量失误的可能性至少是噪声的四倍。它不参与拟合，仍然显示，值得重新测量
word-slow-noise = 慢噪声
word-slow-noise-means = 随时间漂移、与机器人动作无关的误差：三脚架下沉、空气、跟踪仪升温。区间已考虑它，不会把它当作机器人的效应
word-not-identifiable = 无法辨识
word-not-identifiable-means = 对迄今每个样本作用相同的两个原因。差异更大的位姿、第二个反射靶或双向趋近通常能将其区分
word-targets = 已补偿的目标点
word-targets-means = 表格或程序中数值已更改的目标点，使实际工具到达名义机器人应到之处。奇异、超限或有歧义的目标点会被指出并保持不变
word-predicted = 模型预测的位置误差
word-predicted-means = 按模型，实际工具与文件中目标点的距离：使用原数值时，以及使用修正后的数值时
word-language = 读作
word-language-means = 文件的语言，按扩展名判断，否则按内容判断
word-remainder = 无法通过关节指令修正
word-remainder-means = 控制器应用整个表格后仍剩的 RMS 误差：移动该关节无法影响的方向
word-uncertainty = 模型的不确定度
word-uncertainty-means = 由于测量存在离散，模型预测的点可能偏离多远：由拟合的协方差得到的一倍标准不确定度，针对每个测量位姿；多关节机器人还针对各关节范围内的位姿。在许多位姿共同确定模型之处它较小。模型参数未描述的部分不包含在内
word-planar = 平面测量
word-planar-means = 只测量了 x 和 y；对沿 z 的情况无从得知
word-direction = 方向
word-direction-means = 关节到达位姿时的来向。双向趋近才能看出反向间隙
word-polar = 极坐标视图
word-polar-means = 沿关节角度的偏差分量，按球杆仪测试的圆显示 (ISO 230-4)：名义圆上偏差为零，一环代表上方所写的长度。椭圆表示轴倾斜或摆动，偏移的圆表示圆心错误，两个圆表示双向间隙
word-drawn-robot = 工作空间中的机器人
word-drawn-robot-means = 所选或指针下样本处名义机器人的轮廓，旁边的线是实测或辨识出的真实机器人，按旁注的倍数放大位移。未选择时淡显于中间的一个样本处
word-over-time = 偏差-时间
word-over-time-means = 按测量先后的偏差。斜坡是机器或三脚架的漂移；台阶是有人碰触的时刻
word-over-load = 偏差-负载
word-over-load-means = 偏差对手臂负重的关系。斜坡表示手臂或关节变形；需要在不同负载下测量的位姿
word-over-temperature = 偏差-温度
word-over-temperature-means = 偏差对记录温度的关系。斜坡表示连杆伸长，或关节零位随机器升温移动
word-orders = 阶次谱
word-orders-means = 偏差中每转重复一次、两次、三次……的部分有多大。一次是编码器或轴承偏心，两次是椭圆，齿轮出现在其齿数处。低于噪声线的条没有意义
word-histogram = 直方图
word-histogram-means = 各偏差量的样本数。若只剩噪声，条形会填满虚线；两堆表示两种状态，如反向间隙。单击条形可在各处标记其样本
word-effect-curve = 效应曲线
word-effect-curve-means = 模型知道除此效应外的一切时的剩余，以及此效应按拟合大小的作用。曲线穿过各点处，即该效应正确
word-setup = 测站
word-setup-means = 仪器的一个位置。每个测站有自己的测量坐标系，由拟合得到
word-tool = 工具位姿
word-tool-means = 所有关节为零时工具坐标系在基座坐标系中的位置和姿态
word-robot = 机器人
word-robot-means = 测量所依据的描述：图纸上的轴线、反射靶和连杆。一切都以它为基准
word-samples = 样本
word-samples-means = 已测量的位姿。数量越多、差异越大，每个数值越可靠
word-reflectors = 反射靶
word-reflectors-means = 工具上仪器可见的点。在另一半径处的第二个反射靶能区分单个无法区分的原因
word-instrument = 测量仪器
word-instrument-means = 用来测量位置的仪器。其噪声是任何模型所能达到的最小 RMS 误差
word-compensated = 已补偿
word-compensated-means = 测量时指令已由表格修正：此处看到的是该表格剩下的误差
word-range = 测量范围
word-range-means = 测量过的关节最小和最大位置。范围之外一无所知，表格在那里保持端点值
word-hole = 最大空缺
word-hole-means = 范围中远宽于其他步长且没有样本的一段。那里发生的情况看不到：请在其中测量几个位姿
word-speed = 速度
word-speed-means = 测量时关节的运动速度。只有不同速度才能看出对指令的滞后
word-load = 负载
word-load-means = 测量时工具处的质量。只有不同负载才能看出连杆和关节的弯曲
word-temperature = 温度
word-temperature-means = 测量时机器人的温度。温度变化几度才能看出热膨胀
word-took = 时长
word-took-means = 从第一个样本到最后一个。只有样本带时间，才能看出漂移或碰撞
word-shows = 可检验的效应
word-shows-means = 本程序已知的物理原因中，有多少会在这些样本中留下痕迹。无法检验的仍可能存在
word-without = 不修正时
word-without-means = 名义机器人的 RMS 误差：什么都不修正时的剩余
word-modelled = 模型与测量
word-modelled-means = 测量与辨识模型之间的 RMS 误差：若每个方向都可修正，完美的控制器所能达到的水平
word-corrected = 使用修正后的指令
word-corrected-means = 用模型修正指令后，此测量剩余的 RMS 误差
word-entries = 条目
word-entries-means = 表格的行数。越多越贴合曲线；控制器可能只允许一定数量
word-source = 来源
word-source-means = 文件，以及辨识该模型所用的测量。模型的价值取决于其测量的覆盖范围
word-place = 位置
word-place-means = 剩余误差突出的那段范围，或每转周期数：请检查机器的该处
word-curve = 曲线最大值
word-curve-means = 平滑修正在此方向上移动该点的最大量
word-axis = 轴线
word-axis-means = 所有关节为零时，关节绕其转动或沿其移动的直线：方向及其上任一点，在基座坐标系中
figure-a = 准确度：整个轴上从最低到最高的偏差，两侧各加两倍离散
figure-a-one-way = 仅单一趋近方向时的同一指标：程序总从一侧来时的剩余
figure-e = 系统偏差：从最低到最高的平均偏差，不含离散。这是表格可以消除的部分
figure-e-one-way = 仅单一趋近方向时的同一指标
figure-m = 双向平均值从最低到最高：误差沿轴的形状
figure-r = 重复精度：返回同一位置的最大离散，双向合计。任何表格都无法消除
figure-b = 反向差值：两个趋近方向的最大差异。反向间隙和空程在此体现
figure-b-mean = 沿轴平均的同一指标
figure-ap = 位姿准确度：从指令点到实测点中心
figure-rp = 位姿重复性：包含返回同一位姿各点的球的半径，均值加三倍标准差
figure-vap = 从不同方向趋近同一位姿时各中心的差异

## what the core says

finding-expected = { $found }；应为：{ $expected }
finding-at = { $place }：{ $found }

# The core: causes of effects

core-the-column-does-not-stand-upright = 立柱在底座上不垂直
core-the-bearings-raceways-are-wavy-so = 轴承滚道有波纹，轴线在转动时倾斜
core-play-between-gear-teeth-in-a = 齿轮、联轴器或键中存在间隙
core-the-measuring-frame-was-surveyed-to = 测量坐标系被标定到轴线旁的一点
core-raceways-or-seats-of-the-bearing = 轴承滚道或轴承座不圆
core-the-encoders-ring-or-the-gear = 编码器码盘或驱动它的齿轮安装偏心
core-the-encoder-ring-is-tilted-or = 编码器码盘倾斜或呈椭圆，或编码器与轴之间的联轴器弯曲
core-the-pedestal-the-floor-or-the = 基座、地面或底座螺栓在负载和机械臂的力矩下变形
core-the-tripod-settles-or-the-base = 三脚架下沉，或底座蠕变
core-somebody-touched-the-tripod-or-the = 有人碰了三脚架，或底座滑动
core-tooth-or-wavegenerator-errors-in-the = 减速器轮齿或波发生器误差；阶次指出是哪个轮
core-the-instruments-distance-scale-or-its = 仪器的距离尺度，或其气温和气压值不准
core-reducer-bearing-and-shaft-wind-up = 减速器、轴承和轴在关节所承重量下扭转
core-the-gear-ratio-or-the-encoders = 传动比或编码器每转计数输入略有错误
core-the-reference-mark-or-the-homing = 参考标记或回零位置不在控制器假定的位置
core-the-link-or-the-structure-bends = 连杆或结构在负载下弯曲
core-links-are-longer-or-shorter-than = 连杆比图纸长或短，轴线不垂直或不平行
core-the-tool-or-the-link-is = 工具或连杆比控制器数据长或短
core-friction-in-the-reducer-winds-the = 减速器摩擦使传动在每次换向后扭转
core-the-instrument-stands-where-it-was = 仪器位于其架设处
core-the-thread-of-the-screw-is = 丝杠螺纹不均匀，或丝杠轴承或其编码器有跳动
core-the-arm-grows-as-it-warms = 机械臂升温后伸长：钢约 12 ppm/K，铝约 23 ppm/K
core-the-encoders-mounting-or-the-reducer = 编码器安装座或减速器升温时略有转动
core-the-tool-is-mounted-beside-the = 工具安装偏离控制器假定的半径方向
core-the-tool-is-mounted-turned-or = 工具安装有转角，或控制器中的工具数据有转角
core-the-tool-data-in-the-controller = 控制器中的工具数据，或靶标在工具上的位置
core-the-position-loop-follows-late-or = 位置环跟随滞后，或仪器与控制器的时钟不一致
core-unknown-no-effect-of-the-catalogue = 未知：目录中没有效应能解释
core-the-drive-of-one-joint-turns = 一个关节的传动带动另一个关节，而控制器中的耦合比不准确

# The core: what to check

core-shim-the-columns-foot-level-it = 垫平立柱底脚；沿 x 和 y 调平
core-the-bearings-axial-seat-and-preload = 轴承的轴向座面和预紧
core-preload-and-wear-of-the-reducer = 减速器的预紧和磨损；固定驱动端，用手来回扳动输出端
core-survey-the-base-again = 重新测量基座
core-the-bearings-seat-and-preload = 轴承的座面和预紧
core-centre-the-encoder-ring-or-average = 校正码盘中心，或在 180° 处加第二读数头取平均
core-check-the-rings-mounting-face-for = 检查码盘安装面是否倾斜、码盘是否圆
core-the-bolts-and-the-pedestal-a = 螺栓和基座；带载机械臂回转时在底座处用百分表检查
core-tripod-clamps-and-the-sun-on = 三脚架、夹具，以及阳光是否照射三脚架
core-return-to-the-datum-points-after = 突变之后重新测量基准点；夹具和三脚架
core-compare-the-order-with-the-reducers = 将阶次与减速器齿数比较，再检查其预紧和润滑
core-measure-a-scale-bar-the-instruments = 测量基准尺；检查仪器的气象站
core-the-payload-entered-in-the-controller = 控制器中输入的负载；数据手册中减速器的刚度
core-compare-the-gear-ratio-and-the = 将控制器中的传动比和每转计数与数据手册比较
core-home-the-joint-again-and-repeat = 关节重新回零并重复三个位姿
core-the-bolts-between-base-column-and = 底座、立柱和连杆之间的螺栓
core-the-kinematic-data-in-the-controller = 控制器中的运动学数据
core-the-tool-data-in-the-controller-2 = 控制器中的工具数据
core-lubrication-and-preload-of-the-reducer = 减速器的润滑和预紧
core-measure-reference-points-on-the-base = 每次架设都测量基座上的参考点
core-the-screws-runout-and-its-thrust = 丝杠跳动及其推力轴承；丝杠上的联轴器和编码器
core-let-the-machine-warm-up-before = 测量前让机器预热，或在控制器中输入机械臂的膨胀量
core-let-the-machine-warm-up-before-homing = 回零前让机器预热；检查编码器附近的热源
core-the-tool-flange-and-the-tool = 工具法兰和控制器中的工具数据
core-measure-the-targets-on-the-tool = 测量工具上的靶标
core-synchronise-the-clocks-then-the-loops = 先同步时钟，再检查控制环的速度增益和前馈
core-look-at-the-machine-where-the = 在关节处于该范围时检查机器：刻度尺、轴承、电缆、护罩
core-the-coupling-ratio-in-the-controllers = 控制器数据中的耦合比

# The core: usual sizes

core-any = 任意
core-10-m-of-eccentricity-on-a = 半径 50 mm 的码盘偏心 10 µm 即 0.011°
core-005-to-1-mm-005-to = 0.05 至 1 mm，0.05 至 2 mrad
core-012-to-023-mm-per-metre = 每米每 10 K 为 0.12 至 0.23 mm

# The core: parameters

core-about-x = 绕 x
core-about-y = 绕 y
core-about-z = 绕 z
core-amplitude = 幅值
core-compliance = 柔度
core-delay = 延迟
core-delta = 变化量
core-fade = 衰减
core-from-joint = 来自关节
core-lead = 导程
core-offset = 偏移
core-order = 阶次
core-phase = 相位
core-rate = 变化率
core-ratio = 比值
core-scale = 尺度
core-time = 时间
core-width = 宽度

# The core: what stays, and what to do about it

core-of-joint-leaves = 关节 { $b } 的{ $a }残留 { $c }：{ $d }
core-leaves = { $a }残留 { $b }：{ $c }
core-its-part-along-the-radius-belongs = 沿半径方向的部分应写入控制器的工具数据（l1）或基座数据；完整模型会指明是哪一个
core-needs-a-mechanical-repair = 需要机械修理：{ $a }
core-let-the-machine-warm-up-or = 让机器预热，或在控制器中输入机械臂的膨胀量
core-move-the-tool-in-the-controllers = 在控制器的工具数据中将工具沿垂直半径方向移动 { $a }
core-turn-the-base-in-the-controller = 在控制器中将基座绕 x 转 { $a }、绕 y 转 { $b }，或垫平立柱底脚
core-along-the-radius-set-the-tools = 沿半径方向；在控制器中将工具半径（l1）由 { $a } 改为 { $b }
core-move-the-base-in-the-controller = 在控制器中将基座移动 { $a }，或重新测量
core-the-joint-stands-beyond-its-command = 关节超出指令 { $a }：在控制器中修正零位，或重新回零
core-move-the-tools-point-in-the = 在控制器中将工具点在工具坐标系中移动 { $a }

# The core: tables

core-the-numbers-are-corrections-add-them = 数值为修正量：加到指令上，使机器人到达指令位置（偏差 = 实测 − 指令，符号相反）
core-the-numbers-are-deviations-actual-commanded = 数值为偏差（实际 − 指令）：控制器从指令中减去（相加的修正量符号相反）
core-commanded-robot-reached-table-says-send = 指令 { $a }，机器人到达 { $b }，表格给出 { $c }：应发送 { $d }
core-with-this-table-the-controller-leaves = 使用此表，控制器在实测范围内残留 { $a }，精确修正残留 { $b }；{ $c }
core-its-entries-add-less-than = 其 { $a } 个条目引入 { $b }，小于{ $c }（{ $d }）
core-its-entries-add-more-than-the = 其 { $a } 个条目引入 { $b }，大于{ $c }（{ $d }）：步长较大
core-its-entries-add-more-than-takes = 其 { $a } 个条目引入 { $b }，大于{ $c }（{ $d }）：{ $e } 最多接受 { $f }
core-1-of-the-tolerance = 公差的 1 %
core-1-of-001-mm-as-there = 0.01 mm 的 1 %（未给公差）
core-1-of-the-models-rms-error = 模型 RMS 误差的 1 %（未给公差）
core-the-joint-has-no-limits-the = 关节没有限位：表格覆盖实测范围
core-a-step-of-does-not-divide = 步长 { $a } 不能整除行程：步长取 { $b }
core-measured-from-to-outside-the-correction = 实测范围 { $a } 至 { $b }；范围之外保持端点的修正量
core-the-of-this-joint-depends-on = 此关节的{ $a }取决于其他关节：这里它们处于零位
core-the-correction-jumps-at-the-boundaries = 修正量在区域边界处跳变；表格在两个条目之间将其变为斜坡
core-up-to-of-it-is-an = 其中最多 { $a } 为未解释的平滑修正，实测范围 { $b } 至 { $c }：目录中没有效应能解释，范围之外保持端点值

# The core: targets and programs

core-poses-for-which-the-file-declares = 文件未声明坐标系的位姿按{ $a }读取；文件只有一个工具时，控制器的工具必须与模型一致
core-in-the-robots-base-frame = 机器人基坐标系
core-in-the-frame-that-was-stated = 给定的坐标系
core-the-robots-base-is-the-frame = 机器人基座即测量所用的坐标系
core-the-robots-base-is-where-its = 机器人基座位于第一轴处；测量坐标系与其相差 { $a } 和 { $b }（--measured-frame 修正到该坐标系）
core-targets-without-a-load-are-corrected = 未给负载的目标点按 { $a } 修正
core-targets-without-a-temperature-are-corrected = 未给温度的目标点按 { $a } 修正

# The core: tolerance

core-pass = 合格
core-fail = 不合格
core-neither-pass-nor-fail-is-proven = 合格与不合格均未得到证明
core-largest-deviation-expanded-uncertainty-u-k = 最大偏差 { $a }（{ $b }），扩展不确定度 U = { $c }（k = 2），公差 { $d }；判定规则：{ $e }
core-predicted-with-corrected-commands = 按修正后的指令预测
core-as-measured-with-the-table-active = 启用表格时实测
core-simple-acceptance-jcgm-106-82 = 简单接受（JCGM 106，8.2）
core-no-position-was-measured = 未测量任何位置
core-no-command-can-be-corrected = 没有指令可以修正
core-the-noise-of-the-instrument-is = 仪器噪声未知

# The core: noise and fit

core-the-measuring-frame-wanders-by-root = 测量坐标系在 { $b } 内漂移 { $a }（均方根）
core-a-part-of-the-remaining-error = 部分剩余误差在样本之间持续，{ $b } 内为 { $a }（均方根）：诊断会在其中寻找效应
core-as-found-as-stated-for-the = σ = { $a }（实际），{ $b }（仪器标称），{ $c } 倍
core-a-joint-value-or-a-coordinate = 缺少关节值或坐标
core-the-instrument-lost-the-reflector-it = 仪器丢失反射靶：写入了 0, 0, 0
core-by-hand = 手动
core-converged = 已收敛
core-there-was-nothing-to-solve-for = 没有需要求解的量
core-stopped-after-the-largest-number-of = 达到最大步数后停止：结果可能粗略
core-stopped-where-no-step-made-the = 在没有步长能改进拟合处停止：结果可能粗略
core-cancelled = 已取消
core-z-is-not-used-the-method = 未使用 z：该方法在轴带动工具运动的平面内工作
core-corrections-are-constant-in-the-base = 修正量在每个区域内于基坐标系中为常数：关节的一个恒定误差在各区域表现不同，并有残留；完整模型没有这些限制
core-no-sample-in-region-no-correction = 区域 { $a } 没有样本：该处不修正
core-samples-lie-in-no-region-and = { $a } 个样本不在任何区域内，未使用
core-the-targets-do-not-sit-where = 靶标位置与测量所述不符（超出 targets_sigma_mm）：其位置自由拟合
core-beyond-what-is-usual-by-more = 超过通常值四倍以上，不用先验拟合：{ $a }
core-the-measuring-frame-was-never-aligned = 测量坐标系从未与机器人基座对齐（转 { $a }，移 { $b }）：自由拟合
core-the-samples-do-not-depend-on = 样本与其无关：保持为零
core-the-samples-do-not-depend-on-it = 样本与其无关
core-the-samples-show-only-their-sum = 样本只显示它们的和：{ $a } 保持为零，由其他参数承担
core-the-samples-show-only-their-sum-a = 样本只显示它们的和：一个的变化可被其他抵消
core-overall-size-all-lengths-of-the = 总体尺寸：机器人和各位置的所有长度
core-the-base-is-open-what-was = 基座未确定：测量参照的是未知位置，不能说明机器人所在；基座保持不动，由这些位置承担

# The core: a model on other samples

core-the-sessions-robot-has-than-the = 测量中的机器人与模型的{ $a }：使用模型的名义机器人
core-another-tool = 工具不同
core-other-axes = 轴线不同
core-the-session-was-measured-with-this = 测量时启用了此模型的表格：显示的是剩余误差，不再重复补偿
core-the-session-was-measured-with-another = 测量时启用了另一模型的表格：不再重复补偿，此模型不知道该表格的作用
core-belong-to-the-session-that-the = { $a } 属于模型所来自的测量，已略去
core-the-model-knows-no-setup-its = 模型中没有架设 { $a }：其坐标系按这些样本拟合
core-not-known-to-the-model-and = 模型未知，单独定位：{ $a }

# The core: tables of several joints

core-the-table-cancels-what-joint-does = 表格抵消关节 { $a } 对自身{ $b }的影响；几何误差取决于所有关节，应写入控制器的运动学数据
core-angle = 角度
core-travel = 行程

# The core: held out

core-each-fifth-of-the-measurements-of = 每个基准各自的五分之一测量，由未见过它的拟合预测
core-each-of-cells-of-the-workspace = 工作空间 { $a } 个单元中的每一个，由未见过它的拟合预测
core-each-fifth-of-the-cells-of = 工作空间单元的每个五分之一，由未见过它的拟合预测
core-the-samples-that-the-session-marks = 测量中标为留出的样本；未参与任何拟合
core-too-few-samples-to-hold-any = 样本太少，无法留出

# The core: what is left without a name

core-no-effect-of-the-catalogue-explains = { $a }；目录中没有效应能解释
core-the-base-model-does-not-fit = 基础模型不符：轴线、工具或质量；{ $a }
core-what-is-left-looks-most-like = 剩余误差最像{ $a }
core-the-search-stopped-at-its-limit = 搜索在 { $a } 个效应的上限处停止；{ $b }
core-the-remaining-error-of-is-times = { $a }的剩余误差是{ $c }的 { $b } 倍，没有搜索所知的结构
core-the-remaining-error-is-times-what = 剩余误差是{ $b }的 { $a } 倍，没有搜索所知的结构
core-returns-to-the-same-pose-show = 返回同一位姿所显示
core-returns-to-the-same-pose-show-2 = 返回同一位姿所显示（{ $a }）
core-is-stated-for-the-instrument = 仪器标称
core-is-stated-for-the-instrument-2 = 仪器标称（{ $a }）
core-over-the-value-of-joint = 随关节 { $b } 数值的{ $a }，{ $c }
core-over-time = 随时间的{ $a }，{ $b }
core-over-the-side-from-which-joint = 随关节 { $b } 趋近方向的{ $a }，{ $c }
core-over-the-speed-of-joint = 随关节 { $b } 速度的{ $a }，{ $c }
core-over-the-load = 随负载的{ $a }，{ $b }
core-over-temperature = 随温度的{ $a }，{ $b }
core-of-one-reflector-against-the-others = 一个反射靶相对其他的{ $a }，{ $b }
core-a-constant = 常数
core-a-straight-slope = 直线斜坡
core-a-slope-away-from-the-middle = 由中间向外的斜坡
core-a-parabola = 抛物线
core-a-curve-of-no-known-form = 形式未知的曲线
core-a-local-bump = 局部凸起
core-a-step-or-plateau = 台阶或平台
core-a-slope-from-one-value-on = 从某值开始的斜坡
core-a-wave = 波形
core-a-periodic-pattern-with-harmonics = 带谐波的周期图形
core-a-wave-of-one-turn-in = 按比例的一转一周期波形
core-along-the-motion-of-joint = 沿关节 { $a } 的运动方向
core-along-the-radius = 沿半径方向
core-along-the-axis = 沿轴线方向
core-in-the-measuring-frame = 在测量坐标系中
core-with-the-moving-body = 随运动体
core-joint-from-to = 关节 { $a }：{ $b } 至 { $c }
core-speed-of-joint-from-to = 关节 { $a } 的速度：{ $b } 至 { $c }
core-time-from-to = 时间：{ $a } 至 { $b }
core-load-from-to = 负载：{ $a } 至 { $b }
core-temperature-from-to = 温度：{ $a } 至 { $b }
core-cycles-per-turn-of = { $b }每转 { $a } 个周期
core-cycles-per-metre-of = { $b }每米 { $a } 个周期
core-joint = 关节 { $a }
core-speed-of-joint = 关节 { $a } 的速度
core-side-from-which-joint-came = 关节 { $a } 的趋近方向
core-load = 负载
core-temperature = 温度

# The core: what tells explanations apart

core-measure-the-proposed-pose = 测量建议的位姿
core-measure-the-proposed-pose-with = 以{ $a }测量建议的位姿
core-measure-the-proposed-poses = 测量建议的 { $a } 个位姿
core-measure-the-proposed-poses-with = 以{ $b }测量建议的 { $a } 个位姿
core-a-reflector-at-another-radius = 另一半径上的反射靶
core-other-speeds = 不同速度
core-other-loads = 不同负载
core-another-temperature = 不同温度
core-no-pose-within-the-limits-tells = 限位内没有位姿能区分它们；{ $a }
core-approach-the-same-places-from-both = 从两侧趋近同样的位置
core-measure-in-motion-at-two-speeds = 另外在运动中以两种速度测量
core-measure-without-and-with-a-load = 分别在无负载和有负载时测量
core-measure-with-the-machine-cold-and = 在机器冷态和热态测量，并在冷却过程中再测一次
core-spread-the-poses-over-the-whole = 将位姿分布到整个行程
core-mount-a-second-reflector-at-another = 在另一半径处安装第二个反射靶
core-write-down-the-time-of-every = 记录每个样本的时间（time_s）
core-measure-z-as-well = 同时测量 z
core-give-the-direction-of-gravity-in = 在机器人文件中给出重力方向（gravity_m_s2）
core-the-joint-turns-the-effect-needs = 关节是转动的，该效应需要移动关节
core-the-joint-slides-the-effect-needs = 关节是移动的，该效应需要转动关节
core-the-joint-was-measured-at-different = 关节测量了 { $a } 个不同值，至少需要 { $b } 个
core-the-session-does-not-say-from = 测量未说明位姿从哪一侧趋近
core-every-pose-was-approached-from-the = 所有位姿都从同一侧趋近
core-the-session-does-not-say-how = 测量未说明测量时关节的运动速度
core-every-pose-was-measured-at-standstill = 所有位姿都在静止时测量
core-every-pose-was-measured-at-the = 所有位姿都以同一带符号的速度测量
core-the-session-has-no-temperature = 测量没有温度
core-the-temperature-never-changed = 温度没有变化
core-the-session-has-no-time = 测量没有时间
core-every-sample-has-the-same-time = 所有样本的时间相同
core-the-direction-of-gravity-is-not = 未给出重力方向
core-the-session-has-no-load = 测量没有负载
core-the-load-never-changed = 负载没有变化
core-the-robot-has-several-joints-link = 机器人有多个关节：由连杆几何误差代替
core-the-tool-lies-on-the-axis = 工具位于轴线上，没有半径
core-z-was-not-measured-and-the = 未测量 z，而该效应沿轴线方向
core-in-these-samples-it-cannot-be = 在这些样本中无法与几何误差（坐标系、零位、连杆和工具）区分
core-in-these-samples-it-cannot-be-told = 在这些样本中无法与关节零位偏移和连杆长度区分

# The core: mistakes of the set-up

core-in-these-samples-the-same-as = { $a }；在这些样本中等同于：{ $b }
core-joint-counts-the-other-way-round = 关节 { $a } 计数方向相反
core-reverse-the-sign-of-joint-in = 在机器人描述或样本中反转关节 { $a } 的符号
core-joints-and-are-exchanged = 关节 { $a } 和 { $b } 互换了
core-exchange-the-columns-of-joints-and = 交换关节 { $a } 和 { $b } 的列
core-the-measured-points-follow-the-joint = 实测点跟随回读的关节值，而不是指令值
core-start-from-the-values-read-back = 以回读值为准（--joint-values read），并检查指令的来源
core-joints-and-are-coupled-parallelogram-but = 关节 { $a } 和 { $b } 是耦合的（平行四边形机构），却按不耦合读取
core-joints-and-are-uncoupled-but-were = 关节 { $a } 和 { $b } 不耦合，却按耦合（平行四边形机构）读取
core-the-home-position-of-joint-is = 关节 { $a } 的零位偏差 { $b }
core-add-to-joint-at-home-or = 在零位给关节 { $b } 加 { $a }，或重新回零
core-the-home-positions-of-joints-and = 关节 { $a } 和 { $b } 的零位偏差 180°
core-correct-the-unit-in-the-headings = 更正关节列标题中的单位
core-correct-the-unit-in-the-heading = 更正 { $a } 列标题中的单位
core-correct-the-unit-in-the-headings-of = 更正 x、y、z 列标题中的单位
core-two-of-the-measured-axes-are = 两个测量轴互换（如 x 和 y），或其中一个反向
core-the-measured-axes-are-swapped = 测量轴 { $a } 互换了
core-x-and-y = x 和 y
core-y-and-z = y 和 z
core-x-and-z = x 和 z
core-x-y-and-z-read-as = x、y、z（读为 y、z、x）
core-x-y-and-z-read-as-z = x、y、z（读为 z、x、y）
core-exchange-the-headings-of-the-measured = 交换测量列的标题
core-exchange-the-headings-of-the-measured-columns = 交换测量列的标题，或将其中一列反向
core-the-measuring-frame-was-never-aligned-with = 测量坐标系从未与机器人基座对齐
core-align-the-instrument-turned-by-moved = 对齐仪器（转 { $a }，移 { $b }），或给样本加 `setup` 列以拟合坐标系
core-with-the-frame-the-tool-and = 拟合坐标系、工具和零位后，中位误差现为 { $a }，去除该错误后为 { $b }
core-with-zero-offset-and-link-length = 拟合零位和连杆长度后，RMS 误差现为 { $a }，去除该错误后为 { $b }
core-far-beyond-what-adjusting-could-mend = 远超调整所能修正的范围
core-the-median-error-is-as-it = 中位误差现为 { $a }，拟合坐标系后为 { $b }
core-no-geometry-fits-the-samples-as = 没有几何能符合现有样本；拟合坐标系后中位误差为 { $a }
core-the-instrument-lost-the-reflector-in = 仪器丢失反射靶：{ $a }
core-it-wrote-0-0-0 = 仪器写入了 0, 0, 0
core-these-samples-are-left-out-measure = 这些样本已略去；请重新测量
core-the-instrument-saw-reflector-instead-in = 仪器看到的是反射靶 { $a }：{ $b }
core-the-points-lie-where-should-be = 这些点位于 { $a } 应在之处
core-these-samples-are-left-out-correct = 这些样本已略去；请更正其靶标或重新测量
core-the-instrument-was-locked-on-a = 仪器锁定在不动的点上：{ $a }
core-the-measured-point-stays-while-the = 机器人运动时实测点不动
core-sample = 样本 { $a }
core-samples = 样本 { $a }
core-samples-and-more = 样本 { $a } 及另外 { $b } 个
core-the-values-read-back-from-joint = 关节 { $a } 的回读值滞后指令 { $b }
core-read-joint-back-at-standstill-taken = 在静止时回读关节 { $a }；按现状这些值看起来像反向间隙或跟随滞后
core-reverse-joint = 反转关节 { $a }
core-read-joint-as-degrees = 关节 { $a } 按度读取
core-read-joint-as-radians = 关节 { $a } 按弧度读取
core-read-all-joints-as-degrees = 所有关节按度读取
core-read-all-joints-as-radians = 所有关节按弧度读取
core-exchange-joints-and = 交换关节 { $a } 和 { $b }
core-subtract-joint-from-joint = 从关节 { $b } 减去关节 { $a }
core-add-joint-to-joint = 将关节 { $a } 加到关节 { $b }
core-start-from-the-values-read-back-2 = 以回读值为准
core-turn-the-home-of-joint-by = 将关节 { $a } 的零位转 { $b }
core-read-the-coordinates-as-metres = 坐标按米读取
core-read-the-coordinates-as-inches = 坐标按英寸读取
core-read-the-coordinates-as-micrometres = 坐标按微米读取
core-multiply-the-coordinates-by = 坐标乘以 { $a }
core-exchange-x-and-y = 交换 x 和 y
core-read-x-y-z-from = 由 { $a } 读取 x、y、z
core-fit-the-measuring-frame = 拟合测量坐标系
core-remove = 移除{ $a }
core-remove-this-sample = 移除此样本
core-remove-these-samples = 移除这 { $a } 个样本
core-add-joint-in-the-value-of = 在关节 { $b } 的值中加上关节 { $a }
core-subtract-joint-in-the-value-of = 在关节 { $b } 的值中减去关节 { $a }

# The core: findings about a session

core-the-noise-of-the-instrument-is-not = 未给出仪器噪声：由样本估计
core-measured = 已测量：{ $a }
core-measured-with-the-table-of-model = 测量时启用了模型 { $a } 的表格：显示的是剩余误差，不再重复补偿
core-regions-and-overlap = 区域 { $a } 与 { $b } 重叠
core-regions-that-touch-at-most-the = 区域最多相接；重叠部分归先列出者
core-two-regions-are-called = 两个区域都叫 { $a }
core-a-name-of-its-own-for = 每个区域各有名称
core-a-name-of-its-own-for-each = 每个关节各有名称
core-regions-are-for-a-robot-with = 区域仅用于只有一个转动关节的机器人：不会使用
core-targets-but-no-column-target-every = { $a } 个靶标但没有 target 列：所有样本视为 { $b }
core-a-column-target = target 列
core-no-sample-shows-this-target = 没有样本显示此靶标
core-no-sample-has-its-commanded-values = 没有样本同时具有指令值和测量值
core-at-least-one-complete-sample = 至少一个完整样本
core-of-samples-lack-a-commanded-value = { $b } 个样本中有 { $a } 个缺少指令值或全部测量值，无法使用：{ $c }
core-of-samples-are-excluded-by-hand = { $b } 个样本中有 { $a } 个被手动排除，不计入任何数值：{ $c }
core-of-samples-lack-single-coordinates-the = { $b } 个样本中有 { $a } 个缺少个别坐标；其余坐标参与拟合：{ $c }
core-no-column-for-the-measured-z = 没有实测 z 列：测量为平面
core-every-sample-is-held-out-or = 所有样本都被留出或排除：没有可拟合的
core-some-samples-marked-fit = 若干标为 fit 的样本
core-measured-orientations-are-not-of-unit = { $a } 个实测姿态不是单位长度：{ $b }
core-unit-quaternions = 单位四元数
core-samples-are-beyond-the-limits-of = { $a } 个样本超出关节 { $b } 的限位：{ $c }
core-commands-within-the-limits = 指令在限位之内
core-negative-loads = 负的负载：{ $a }
core-0-kg-or-more = 0 kg 或更大
core-temperatures-below-absolute-zero = 低于绝对零度的温度：{ $a }
core-the-time-does-not-increase-at = 时间在 { $a } 处未增加；以文件顺序为测量顺序
core-setups-each-has-a-measuring-frame = { $a } 次架设：各有自己的测量坐标系
core-the-instrument-lost-the-reflector-0 = 仪器在 { $a } 个样本中丢失反射靶（0, 0, 0）：{ $b }
core-they-are-left-out = 已略去

# The core: figures of the standards

core-samples-are-left-out-a-cell = 略去 { $a } 个样本：缺少数值、反射靶丢失或被手动排除
core-no-point-was-measured-xmm-ymm = 未测量任何点（x_mm, y_mm）：两项标准的数值针对指令位置处的实测位置；仅有距离、方向、靶座和触测得不出
core-the-session-was-measured-with-a = 测量时启用了表格：数值为补偿后的，不再重复补偿
core-samples-were-taken-in-motion-the = 样本在运动中采集；标准在静止时测量，因此这些数值含有跟随滞后
core-poses-with-two-cycles-or-more = { $a } 个位姿有两个及以上循环，{ $b } 个来自多个方向，{ $c } 条轨迹；各取最大值
core-no-pose-was-reached-twice-from = 没有位姿在到达其他位姿后从同一方向到达两次
core-no-pose-was-repeated-from-several = 没有位姿从多个方向重复
core-z-was-not-measured-figures-are = 未测量 z：数值为平面内

# The core: import

core-decimal-point = 小数点为句点
core-decimal-comma = 小数点为逗号
core-the-unit-of-the-joint-values = 未说明关节值的单位

# The core: units that were mistaken

core-the-values-of-joint = 关节 { $a } 的值{ $b }
core-the-values-of-all-joints = 所有关节的值{ $a }
core-are-in-degrees-but-were-read = 以度为单位，却按弧度读取
core-are-in-radians-but-were-read = 以弧度为单位，却按度读取
core-the-measured-coordinates-are = 实测坐标{ $a }
core-in-metres-but-were-read-as = 以米为单位，却按毫米读取
core-in-micrometres-or-were-multiplied-by = 以微米为单位，或被乘以 1000
core-in-inches-but-were-read-as = 以英寸为单位，却按毫米读取
core-in-millimetres-but-were-read-as = 以毫米为单位，却按英寸读取
core-the-unit-of-x-y-z = 未说明 x、y、z 的单位：{ $a }
core-the-points-spread-over-as-m = 点分布在 { $a } 范围：若为 m 则 { $b }，mm 则 { $c }，in 则 { $d }；{ $e }
core-would-suit = { $a }较合适，{ $b }
core-as-robots-are-mostly-as-large = 因为机器人多与人大小相当
core-beside-a-robot-that-reaches = 机器人工作半径为 { $a }
core-positions-each-approached-from-below-and = { $a }；{ $b } 个位置，各自{ $c }由下趋近、{ $d }由上趋近
core-all-samples-alike = 所有样本条件相同
core-reflector = 反射靶 { $a }
core-reflector-2 = 反射靶 { $a }，{ $b }
core-load-2 = 负载 { $a }
core-load-3 = 负载 { $a }，{ $b }
core-measured-at = 以 { $a } 测量
core-measured-at-2 = 以 { $a } 测量，{ $b }
core-setup = 架设 { $a }
core-setup-2 = 架设 { $a }，{ $b }
core-other-joints-at = 其他关节位于 { $a }
core-never = 从不
core-once-or-more = 一次或多次
core-twice-or-more = 两次或多次
core-times-or-more = { $a } 次或更多
core-more-series-under-other-conditions-are = 其他条件下的另外 { $a } 组数据见 `standards --json`
core-of-positions-have-fewer-approaches-than = { $b } 个位置中有 { $a } 个趋近次数少于其他位置，已略去
core-not-every-position-was-approached-from = 并非每个位置都由{ $a }趋近：没有需要该侧的数值，也没有反向差值
core-a-position-was-approached-once-from = 有一个位置仅由{ $a }趋近一次：没有标准差，因此没有重复性和精度
core-below = 下
core-above = 上
core-approaches-from-each-side-the-standard = 每侧 { $a } 次趋近；标准要求 { $b } 次
core-positions-over-the-standard-asks-for = { $b } 内有 { $a } 个位置；标准要求 { $c } 个
core-paths-with-as-few-as-cycles = 轨迹最少只有 { $a } 个循环；标准要求 { $b } 个
core-poses-with-as-few-as-cycles = 位姿最少只有 { $a } 个循环；标准要求 { $b } 个
core-no-pose-beside-the-paths-was = 轨迹之外没有位姿到达两次
core-the-side-from-which-a-joint = 未知关节从哪侧趋近：各方向视为同一方向
core-the-side-from-which-the-joint = 未知关节从哪侧趋近：缺少列 { $a }
core-metres = 米
core-millimetres = 毫米
core-inches = 英寸
core-an-iso-2302-run-targets-and = ISO 230-2 测试：单轴的目标和位置
core-a-camera-that-sees-a-calibration = 观察标定板的相机：每幅图像的 rvec 和 tvec
core-a-tum-trajectory-time-position-quaternion = TUM 轨迹：时间、位置、四元数
core-any-program-a-table-with-a = 任意程序：带表头的表格，或在下方选择列
core-an-mcap-recording-joint-states-and = MCAP 记录：关节状态和实测位姿
core-a-ballbar-a-drawwire-or-an = 球杆仪、拉线传感器或干涉仪：距离
core-a-laser-tracker-or-spatialanalyzer-names = 激光跟踪仪或 SpatialAnalyzer：名称、x、y、z

# The core: places in files

core-line-column = { $a }，第 { $b } 行，第 { $c } 列，{ $d }
core-line-column-2 = { $a }，第 { $b } 行，第 { $c } 列
core-line = { $a }，第 { $b } 行
core-line-column-3 = 第 { $a } 行，第 { $b } 列
core-line-2 = 第 { $a } 行

# The core: exports

core-zeros-base-and-tool-frame = 零位、基坐标系和工具坐标系
core-mjcf-with-corrected-bodies = 带修正体的 MJCF
core-urdf-with-corrected-origins = 带修正原点的 URDF
core-kinematics-of-urdescription = ur_description 运动学
core-denavithartenberg-rows = Denavit–Hartenberg 参数
core-lerobot-motor-calibration-and-urdf = LeRobot 电机标定和 URDF
core-c99-header-with-a-lookup-function = 带查找函数的 C99 头文件
core-csv-table-with-json-metadata = 带 JSON 元数据的 CSV 表格
core-twincat-cnc-isg-list = TwinCAT CNC（ISG）列表
core-twincat-nc-structured-text = TwinCAT NC 结构化文本
core-the-numbers-are-the-corrected-geometry = 数值即修正后的几何：关节和工具的真实位置；不加到指令上
core-this-robot-carries-it-is-from = 此机器人描述包含{ $a }；在实测范围内与模型相差 { $b }（最大 { $c }），名义机器人相差 { $d }（均方根）
core-zero-offsets-base-and-tool-frame = 零位、基坐标系和工具坐标系
core-zero-offsets-base-and-tool-frame-and = 零位、基坐标系和工具坐标系以及连杆几何
core-at-home-the-nominal-tool-is = 在零位，名义工具位于 { $a }，此机器人的工具位于 { $b }
core-has-no-place-in-at-standstill = { $a }无法写入 { $b }：静止、无负载、20 °C 时无残留
core-has-no-place-in-it-leaves = { $a }无法写入 { $b }：残留 { $c }
core-the-zero-offsets-are-in-this = 零位偏移已在此文件中：控制器的零位保持不变
core-no-joint-has-a-zero-offset = 没有关节需要控制器修正零位
core-the-zero-offsets-are-left-to = 零位偏移留给控制器，不在此文件中：关节超出其显示值，{ $a }；移动零位使显示值相应增大
core-the-zero-offsets-in-this-file = 此文件中的零位偏移由控制器采用：显示值应增大各关节超出指令的量
core-base-where-the-robot-really-stands = base：机器人在基坐标系中的真实位置；tool：真实工具在名义工具坐标系中的位置（新工具数据 = 现有工具数据乘以此值）；zeros：各关节超出指令的量
core-base-the-robots-base-in-the = base：机器人基座在基坐标系中的位置；tool：真实工具在名义工具坐标系中的位置
core-the-geometry-of-the-links-is = 这些数值不含连杆几何；dh、urdf 或 mjcf 包含
core-rows-cannot-say-where-the-first = 参数行无法说明第一轴在基座中的位置：请同时输入 base
core-base-the-frame-before-the-first = base：首行之前的坐标系在基坐标系中；tool：工具在末行之后的坐标系中
core-rows-in-the-convention = 采用 { $a } 约定的参数行
core-base-the-frame-that-the-first = base：首个连杆所在坐标系；tool：TCP 在 wrist_3 坐标系中
core-set-the-tcp-to-with-the = 将 TCP 设为 { $a }，旋转矢量 { $b }：工具不在此文件中
core-for-the-launch-argument-kinematicsparamsfile-the = 用于启动参数 kinematics_params_file；驱动会将其哈希值与控制器自带标定比较并警告不一致
core-masses-are-not-written-a-calibration = 不写入质量：标定不知道连杆的惯量
core-names-that-are-empty-or-not = 空的或重复的名称已更改：文件要求各有其名
core-syntax-from-the-manual-not-tried = 语法依据手册，未在控制器上试验
core-the-motors-show-more-than-before = 电机显示值比以前大（刻度）：{ $a }；其范围随之移动：试验之前远离限位
core-the-calibration-by-itself-with-the = 仅用标定和名义 URDF，在实测范围内残留 { $a }（级别：零位）
core-feetech-present-actual-homingoffset-a-joint = Feetech：present = actual − homing_offset；超出指令的关节 homing_offset 变小
core-dynamixel-present-actual-homingoffset-a-joint = Dynamixel：present = actual + homing_offset；超出指令的关节 homing_offset 变大
core-the-calibration-by-itself-carries-the = 标定文件包含零位；旁边的 URDF 包含其余部分，且只与此电机标定一致
core-the-zero-offsets-are-in-homingoffset = 零位偏移以整数刻度写入此标定的 homing_offset，其余在旁边的 URDF 中：不得在别处重复采用
core-the-zero-offsets-are-in-the = 零位偏移在此标定旁边的 URDF 中，标定保持不变
core-no-calibration-was-given-the-homing = 未给出标定：homing offset 从 0 计，编号和范围为占位；请用 --reference 给出测量时启用的标定
core-in-the-ini-file-the-joint = INI 文件中：{ $a }；关节为 { $b }
core-backlash-is-ignored-while-compfile-is = 设置 COMP_FILE 时忽略 BACKLASH：由两列承担
core-in-the-machine-data-md38000-mmenccompmaxpoints = 机床数据：MD38000 MM_ENC_COMP_MAX_POINTS 至少 { $a }，加载后 { $b }；轴名须为 { $c }
core-switched-on-after-referencing-the-axis = 回参考点后启用，轴会立即移动参考点处的修正量，0 处为 { $a }
core-the-808d-holds-points-for-it = 808D 最多 { $a } 点；请为其给出更大步长
core-ismodulo-1-is-for-a-modulo = IS_MODULO = 1 用于模态轴；有限位的轴请设为 0
core-modulo-1-is-for-a-modulo = modulo 1 用于模态轴；有限位的轴请设为 0
core-in-the-axis-list-have-to = 轴列表中：{ $a }；{ $b } 必须与该轴一致；不得同时使用其他间隙补偿
core-the-largest-value-needs-a-build = 最大值 { $a } 需要 32 位数值的版本；旧版本为 16 位
core-in-the-plc-the-axis-counts = PLC 中：{ $a }；轴的单位为 { $b }
core-no-joint-removes-root-mean-square = 没有关节能消除 { $a }（实测范围内均方根）

# The core: poses to measure next

core-makes-and-more-testable = 使 { $a } 及另外 { $b } 个可检验：{ $c }
core-makes-testable = 使 { $a } 可检验：{ $b }
core-what-the-others-are-compared-with = 供其他比较
core-tells-they-differ-most-at = 区分 { $a }：差异最大处为 { $b }
core-not-determined = 未确定
core-implausibly-large-more-than-ten-times = 大得不合理：超过通常值的十倍
core-not-determined-by-these-samples = { $a }：这些样本无法确定
core-any-size-there-is-no-noise = { $a }：任意大小，没有噪声
core-not-observable-with-these-poses = { $a }：这些位姿不可观测
core-pose = 位姿
core-from = 趋近方向
core-reflector-3 = 反射靶
core-conditions = 条件
core-second-time = 第二次
core-is-a-new-reflector-mount-it = { $a } 是新的反射靶：安装在工具坐标系的 { $b } 处，并测量其真实位置
core-with = 与
core-joint-2 = 关节 { $a }（{ $b }）
core-poses = 位姿

# The core: what of a program is not corrected

core-its-position-is-singular-a-small = 其位置奇异：很小的修正需要关节大幅运动
core-the-real-tool-does-not-reach = 真实工具到达不了：相差 { $a }
core-its-correction-would-lead-into-another = 修正会导致不同的构型
core-with-its-correction = 修正后{ $a }
core-no-joint-values-within-the-limits = 限位内没有关节值能到达
core-endlessly-many-joint-values-reach-it = 有无穷多关节值能到达，之前没有目标点说明用哪组
core-no-joint-values-near-those-of = 前一目标点附近没有关节值能到达
core-joint-values-reach-it-but-none = 有关节值能到达，但构型不符
core-several-joint-values-reach-it-and = 有多组关节值能到达，之前没有目标点说明用哪组
core-two-sets-of-joint-values-reach = 两组关节值能到达，且与前一目标点同样接近
core-no-joint-values-reach-it = 没有关节值能到达
core-it-is-singular-lines-of-joint = 奇异：一条线上的关节值都能到达
core-joint-would-be-at-beyond-its = 关节 { $a } 将位于 { $b }，超出限位 { $c }
core-its-orientation-is-none = 其姿态无效
core-goes-to-which-is-worked-out = { $a } 前往 { $b }，运行时才计算
core-is-worked-out-at-run-time = { $a } 在运行时计算
core-is-changed-at-run-time = { $a } 在运行时更改
core-is-chosen-at-run-time = { $a } 在运行时选择
core-is-not-written-out-in-numbers = { $a } 不是数值
core-is-declared-elsewhere = { $a } 在别处声明
core-is-declared-several-times = { $a } 重复声明
core-has-its-numbers-elsewhere = { $a } 的数值在别处
core-has-no-value-in-this-file = { $a } 在此文件中没有值
core-shifts-the-poses-after-it = { $a } 平移其后的位姿
core-moves-by-a-way-from-where = { $a } 相对机器人当前位置运动
core-its-frame-is-not-known = 坐标系未知：{ $a }
core-its-tool-is-not-known = 工具未知：{ $a }
core-its-tool-is-declared-elsewhere = 其工具 { $a } 在别处声明
core-which-tool-it-is-of-is = 未说明属于哪个工具
core-is-gone-to-from-several-sides = { $a } 从多侧趋近；略去与方向有关的效应
core-is-used-here-as-well-with = 此处也使用 { $a }，采用修正后的值
core-is-a-pose-that-no-move = 此文件中没有运动前往位姿 { $a }
core-is-not-corrected = { $a } 未修正：{ $b }
core-another-routine-of-this-file-sets = 此文件的另一例程设置它
core-it-is-set-in-a-branch = 在分支或循环中设置

# The core: held out by joint

core-each-fifth-of-the-positions-of = 关节 { $a } 各位置（分布于其行程）的每个五分之一，由未见过它的拟合预测
core-no-two-positions-of-the-joint = 没有两个关节位置在其他条件（其他关节、反射靶、负载、速度）相同且反射靶偏离轴线时测量
core-semicolons = 分号
core-commas = 逗号
core-tabs = 制表符
core-spaces = 空格

# The core: steps of the gap chart

core-nominal-robot = 名义机器人
core-zero-offset-and-link-length = 零位偏移和连杆长度
core-geometry-frame-zero-offsets-links-and = 几何：坐标系、零位、连杆和工具
core-full-model = 完整模型

# The core: problems of a file

core-expected = { $a }：{ $b }；应为：{ $c }
core-the-end-of-the-document = 文档结尾
core-the-end-of-the-file = 文件结尾
core-a-key-in-double-quotes = 双引号中的键
core-the-key-a-second-time = 键 { $a } 重复出现
core-every-key-once = 每个键一次
core-after-the-key = 键后的 ':'
core-or = ',' 或 ']'
core-a-text = 文本
core-an-object = 对象
core-an-array = 数组
core-an-array-of-objects = 对象数组
core-an-array-of-numbers = 数字数组
core-an-array-of-numbers-null-where = 数字数组（缺失处为 null）
core-an-array-of-texts-null-where = 文本数组（缺失处为 null）
core-an-array-with-an-object-for = 每个关节一个对象的数组
core-an-array-with-a-frame-for = 每个关节一个坐标系的数组
core-an-array-of-regions = 区域数组
core-an-array-of-names-of-stations = 测站名称数组
core-an-array-of-numbers-2 = { $a } 个数字的数组
core-an-array-of-numbers-3 = { $a } 个数字的数组：{ $b }
core-the-position-in-the-tool-frame = 工具坐标系中的位置，mm
core-the-position-in-the-measuring-frame = 测量坐标系中的位置，mm；或 null
core-the-centre-at-home-in-the = 零位时的中心，基坐标系中
core-a-direction-that-is-not-zero = 非零方向
core-where-the-tracker-stands-mm = 跟踪仪所在位置，mm
core-an-object-with = 含 { $a } 的对象
core-an-object-with-and = 含 { $a } 和 { $b } 的对象
core-an-object-with-and-2 = 含 { $a }、{ $b } 和 { $c } 的对象
core-an-object-with-or-null = 含 { $a } 的对象，或 null
core-an-object-with-and-or-null = 含 { $a } 和 { $b } 的对象，或 null
core-an-object-with-a-number-for = 每个参数一个数字的对象
core-an-object-with-a-position-for = 每个名称一个位置的对象
core-an-object-with-an-array-for = 每列一个数组的对象
core-an-object-with-an-entry-for = 每个名称一项的对象
core-an-object-that-describes-the-robot = 描述机器人的对象
core-an-object-that-describes-a-region = 描述区域的对象
core-an-object-that-describes-a-joint = 描述关节的对象
core-a-number-above-0 = 大于 0 的数
core-a-number-above-0-or-null = 大于 0 的数，或 null
core-a-positive-number-or-an-array = 正数，或 3 个正数的数组
core-a-range-from-the-smaller-to = 从小到大的范围
core-a-region-from-the-smaller-to = 从小到大的区域
core-an-empty-array = 空数组
core-a-robot-without-joints = 没有关节的机器人
core-a-direction-of-zero-length = 长度为零的方向
core-a-quaternion-of-zero-length = 长度为零的四元数
core-an-axis-of-zero-length = 长度为零的轴
core-a-direction-such-as = 方向，例如 { $a }
core-a-quaternion-such-as = 四元数，例如 { $a }
core-a-number-that-a-double-can = 双精度可表示的数（小于 1.8e308）
core-a-number-that-overflows = 溢出的数
core-an-array-with-a-number-that = 含溢出数的数组
core-an-array-with-null-in-it = 含 null 的数组
core-one-finite-number = 一个有限数
core-a-length-above-0-mm = 大于 0 mm 的长度
core-a-length-above-0-mm-or = 大于 0 mm 的长度，或 null
core-a-mass-of-0-kg-or = 0 kg 或以上的质量
core-a-joint-counted-from-1 = 关节，从 1 起计
core-a-name-that-truepose-effects-lists = `truepose effects` 列出的名称
core-one-of-joints-with-tool-dh = joints（带 tool）、dh、urdf 或 mjcf 之一
core-not-a-regular-file = 不是普通文件
core-a-file-that-grows = 正在增长的文件
core-a-document-with-a-key-format = 含键 format 的文档
core-a-json-value = JSON 值
core-a-text-that-never-ends = 没有结束的文本
core-a-control-character-in-a-text = 文本中的控制字符
core-regions-of-another-robot-than-one = 不是单个旋转关节机器人的区域
core-no-regions-for-this-robot = 此机器人没有区域
core-rows-that-a-robot-can-be = 可构成机器人的行
core-a-station-of-the-session = 测量中的测站
core-an-include-that-leads-elsewhere = 指向别处的 include
core-a-link-that-leaves-the-folder = 指向文件夹之外的链接
core-a-json-number-such-as-125 = JSON 数值，如 -12.5 或 3e-4
core-key-is-not-known-ignored = 未知的键 { $a }：已忽略
core-no-key = 缺少键 { $a }
core-a-number = 数值
core-a-name-without-spaces-around-it = 前后没有空格的名称
core-no-sample = 没有样本
core-at-least-one = 至少一个
core-more-cells-like-these-from-here = 此后还有 { $a } 个同类单元格
core-1-1-or-0-unknown = 1、-1 或 0（未知）
core-a-target-of-the-session = 测量中的靶标：{ $a }
core-an-empty-cell-while-there-are = 有多个靶标而单元格为空
core-target-is-not-declared = 未声明靶标 { $a }
core-fit-heldout-or-excluded = fit、held-out 或 excluded
core-a-column-for-each-quantity = 每个量一列
core-one-column-for-each-quantity-remove = 每个量一列：请删除其中之一
core-column-is-not-known-kept-and = 未知的列 { $a }：保留但忽略
core-joint-does-not-exist = 不存在关节 { $a }
core-a-joint-of-the-robot-from = 机器人的关节，1 至 { $a }
core-a-length = 长度
core-an-angle = 角度
core-no-column-for-the-commanded-value = 没有关节 { $a } 指令值的列
core-no-column-for-the-measured = 没有实测 { $a } 的列
core-one-of-the-two-columns-of = 测量方向的两列之一
core-both-azimuthdeg-and-elevationdeg-or-none = azimuth_deg 和 elevation_deg 都有或都没有
core-all-of-qw-qx-qy-qz = qw、qx、qy、qz 全有或全无
core-a-line-of-headings = 标题行
core-an-empty-file = 空文件
core-a-line-of-headings-and-one = 一行标题，每个样本一行
core-a-binary-file-it-holds-nul = 二进制文件（含 NUL 字节）
core-a-csv-file-headings-and-one = CSV 文件：标题行，每个样本一行
core-numbers-in-the-first-line = 首行为数值：{ $a }
core-a-file-in-utf16 = UTF-16 文件
core-utf8-text-truepose-import-file-as = UTF-8 文本；`truepose import FILE --as csv` 可读 UTF-16
core-bytes-that-are-not-utf8 = 非 UTF-8 字节
core-a-json-document-in-utf8 = UTF-8 的 JSON 文档
core-the-line-ends-after = 该行在 { $a } 之后结束
core-one-for-each-heading = { $a }，每个标题一个
core-more-problems-of-this-kind = 另有 { $a } 个同类问题
core-a-directory = 目录
core-a-device-or-a-pipe = 设备或管道
core-no-such-folder = 没有此文件夹
core-a-file = 文件
core-a-folder = 文件夹
core-a-file-that-can-be-read-to-its-end = 可读取到结尾的文件
core-a-regular-file = 普通文件
core-no-such-file = 没有此文件
core-no-permission-to-read-it = 没有读取权限
core-a-file-that-can-be-read = 可读取的文件
core-a-path-that-leads-upwards = 通向上级的路径
core-an-absolute-path = 绝对路径
core-a-quote-that-nothing-closes = 未闭合的引号
core-a-second-quote-or-none = 第二个引号，或没有
core-no-table-no-line-of-cells = 不是表格：没有含数值的行
core-rows-of-cells-between-tabs-semicolons = 以制表符、分号、逗号或空格分隔的行
core-more-cells-or-rows-like-these = 另有 { $a } 个同类单元格或行
core-no-row-that-can-be-read = 没有可读取的行
core-a-number-with-a-decimal-point = 带小数点的数值
core-a-number-with-a-decimal-comma = 带小数逗号的数值
core-a-finite-number-or-an-empty = 有限数值；缺失处为空单元格
core-a-time-seconds-or-1234567 = 时间：秒数或 12:34:56.7
core-no-measurement-falls-into-the-time = 没有测量落在指令的时间内
core-no-measurement-falls-into-a-stop = 没有测量落在指令的停顿内
core-of-measurements-were-taken-at-stops = { $b } 次测量中 { $a } 次在停顿时采集：全部保留并带速度
core-left-out-of-measurements-taken-before = 略去 { $b } 次测量中的 { $a } 次，在首个指令之前或末个指令之后采集：{ $c }
core-exists-already-force-replaces-it = { $a }：已存在；--force 可替换
core-cancelled-2 = { $a }：已取消
core-a-pointing-run-for-tpoint-where = TPOINT 指向观测：机架的位置与恒星的位置
core-angles-of-the-orientation = 姿态角
core-socket = 球窝
core-plane = 平面
core-distances-between-sockets = 球窝之间的距离
core-axis-of-the-tool-that-points = 工具的指向轴
core-columns-that-may-be-what-was = 可能是测量值的列：{ $a }
core-the-unit-of-the-angles-is = 未说明角度的单位
core-the-orientation-is-there-as-a = 姿态同时以四元数和角度给出
core-three-angles-of-an-orientation-and = 姿态的三个角，但未说明轴的顺序，也未说明轴是否随动
core-the-angles-turn-in-the-order = 角度按 { $a } 的顺序转动，但未说明是绕固定轴（测量坐标系）还是绕随动轴
core-lists-read-as-a-table-of = 列表，按 { $a } 行 { $b } 列的表格读取
core-no-header-the-columns-are-taken = 没有表头：各列视为 { $a }
core-target = 靶标 { $a }
core-fit-the-places-of-the-targets = 拟合靶标的位置
core-target-is-elsewhere-from-its-stated = 靶标 { $a } 不在原处：距其在工具上标注的位置 { $b }
core-its-place-is-fitted-moved-by = 其位置由拟合确定（移动 { $a }、{ $b }、{ $c } mm）；请重新测量，或给出 targets_sigma_mm
core-the-base-model-leaves-as-it = 基础模型按原样剩余 { $a }，位置自由时剩余 { $b }；可能性高 { $c } 倍
core-the-socket-that-the-target-sat = 没有列指明时，所有行中靶标所在的座：此时只需关节值
core-the-plane-that-was-touched-in = 没有列指明时，所有行中接触的平面：此时只需关节值
core-known-distances-between-sockets-mm-such = 座之间的已知距离，mm，例如 S1-S2=400：其中一个确定机器人的尺寸
core-how-rx-ry-rz-or-euler1 = rx、ry、rz（或 euler1、euler2、euler3）如何构成姿态：轴的次序以及轴是否随动，例如 zyx-moving、xyz-fixed（= zyx-moving）或 zyz-moving；rpy（= xyz-fixed）；rotvec
core-its-position-is-nearly-singular-the = 其位置接近奇异：修正会使工具转动 { $a }
core-the-search-was-stopped-this-is = 搜索已停止：以下是到此为止已证实的结果
core-the-search-was-stopped-this-is-2 = 搜索已停止：以下是到此为止已证实的结果；{ $a }
core-the-search-stopped-at-its-budget = 搜索达到计算预算：以下是到此为止已证实的结果
core-the-search-stopped-at-its-budget-2 = 搜索达到计算预算：以下是到此为止已证实的结果；{ $a }
core-a-smooth-curve-over-joint-explains = 关节 { $a } 上的一条平滑曲线与 { $b } 合起来的解释力相同
core-the-remaining-error-is-times-the = 剩余误差是噪声下限（{ $b } mm）的 { $a } 倍：测量坐标系在漂移，或有同样缓慢的变化
core-on-the-session-that-it-came = 在模型所来自的测量上，模型的 RMS 误差为 { $a } mm，而所述为 { $b } mm：不写入
core-on-the-session-that-it-came-2 = 在模型所来自的测量上，模型的 RMS 误差为 { $a } mm，名义机器人为 { $b } mm：不写入
core-the-model-leaves-an-rms-error = 模型的 RMS 误差为 { $a } mm，其起始辨识为 { $b } mm：不写入
core-the-model-predicts-no-position-at = 模型在关节值 { $a }（rad，mm）处不能预测位置：不写入
core-with-this-the-rms-error-of = 使用该输出（{ $a }）时，“{ $b }”的 RMS 误差会从 { $c } 升至 { $d } mm：不写入任何内容
core-description-of-the-robot = 机器人描述

robots-robots = 机器人
robots-robots-2 = 机器人…
robots-type-a-maker = { $count } 种常用机器人及其标称几何：输入制造商、型号或类型
robots-hint = 例如 ur5e、kuka kr 6、scara
robots-find-a-robot = 查找机器人
robots-no-robot-has-this-name = 没有此名称的机器人
robots-at-its-zero = { $robot } 处于零位
robots-kind = 类型
robots-reach = 臂展、负载
robots-repeatability = 重复精度 (ISO 9283)
robots-source = 几何来源
robots-not-checked = 未经第二来源核对：{ $what }
robots-six-joints = 六关节
robots-six-joints-offset-wrist = 六关节，偏置腕
robots-seven-joints = 七关节
robots-positioner = 变位机
robots-rotary-axis = 转轴
robots-save-robot-file = 保存机器人文件…
robots-save-robot-file-2 = 保存机器人文件
robots-robot-json = 机器人 (*.json)
robots-a-file-for-sessions = 可用于会话、导入和规划的文件
robots-simulate = 仿真…
keys-robots = 机器人库
simulation-poses = 位姿数
simulation-joint = 关节
simulation-poses-from-one = 位姿数为 1 至 { $most }
simulation-a-robot-of-the-library = 位姿分布于各关节范围，工具上有三个反射器，混合不同速度、负载和升温过程。此处填写的内容即诊断应找到的内容
hidden-show = 显示隐藏的内容
hidden-hide = 不显示隐藏的内容
hidden-hidden = 此仿真中隐藏的内容
hidden-nothing = 无
hidden-found = 已找到
hidden-identified = 已辨识
hidden-not-found = 未找到
